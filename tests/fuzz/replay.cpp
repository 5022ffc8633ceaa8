// tests/fuzz/replay.cpp
// Runs a fuzz target without libFuzzer: replay FOLDER N feeds every file of the corpus and N
// variants of each, made with a fixed seed by cutting, repeating and changing bytes.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> read_corpus(const std::string& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<Bytes> corpus;
  for (const auto& name : names) {
    std::ifstream file(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

Bytes changed(Bytes bytes, std::mt19937_64& random) {
  const auto below = [&random](std::size_t n) { return random() % n; };
  const std::size_t n_changes = 1 + below(4);
  for (std::size_t change = 0; change < n_changes && !bytes.empty(); ++change) {
    const std::size_t at = below(bytes.size());
    const auto here = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 64));
    const Bytes piece(here, here + static_cast<std::ptrdiff_t>(length));
    switch (below(6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.insert(here, piece.begin(), piece.end());
        break;
      case 2:
        bytes.erase(here, here + static_cast<std::ptrdiff_t>(length));
        break;
      case 3:
        std::fill(here, here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(length, 8)), 0xff);
        break;
      case 4:
        *here ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      default:
        *here = static_cast<std::uint8_t>("0123456789-.,eE\n\"[]={}"[below(23)]);
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "replay FOLDER N\n";
    return 2;
  }
  const std::vector<Bytes> corpus = read_corpus(argv[1]);
  const int n = std::stoi(argv[2]);
  std::mt19937_64 random(1);
  for (const Bytes& bytes : corpus) {
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    for (int k = 0; k < n; ++k) {
      const Bytes variant = changed(bytes, random);
      LLVMFuzzerTestOneInput(variant.data(), variant.size());
    }
  }
  std::cout << corpus.size() << " files, " << corpus.size() * static_cast<std::size_t>(n)
            << " variants, " << talus::n_accepted << " accepted\n";
  return corpus.empty() ? 1 : 0;
}
