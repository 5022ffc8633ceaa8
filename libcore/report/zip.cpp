// Writes a ZIP archive of a few small files, stored without compression.
#include "report/zip.hpp"

#include <array>
#include <cstdint>

namespace talus {
namespace {

// CRC-32 of IEEE 802.3, reflected polynomial 0xedb88320.
std::uint32_t crc32(const std::string& bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> values{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int k = 0; k < 8; ++k) c = c & 1u ? 0xedb88320u ^ c >> 1 : c >> 1;
      values[i] = c;
    }
    return values;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 255u] ^ crc >> 8;
  return ~crc;
}

void put(std::string& out, std::uint32_t value, int n_bytes) {
  for (int k = 0; k < n_bytes; ++k) out += static_cast<char>(value >> (8 * k) & 255u);
}

constexpr std::uint32_t version = 20, utf8 = 0x0800, stored = 0;
constexpr std::uint32_t first_day = 0x0021;  // 1980-01-01, the earliest there is

// Fields that the local header and the central directory have in common.
void put_description(std::string& out, const std::string& name, const std::string& content) {
  put(out, version, 2);
  put(out, utf8, 2);
  put(out, stored, 2);
  put(out, 0, 2);  // midnight
  put(out, first_day, 2);
  put(out, crc32(content), 4);
  put(out, static_cast<std::uint32_t>(content.size()), 4);
  put(out, static_cast<std::uint32_t>(content.size()), 4);
  put(out, static_cast<std::uint32_t>(name.size()), 2);
  put(out, 0, 2);  // no extra field
}

}  // namespace

std::string zip_archive(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out, directory;
  for (const auto& [name, content] : files) {
    const auto offset = static_cast<std::uint32_t>(out.size());
    put(out, 0x04034b50, 4);
    put_description(out, name, content);
    out += name + content;

    put(directory, 0x02014b50, 4);
    put(directory, version, 2);
    put_description(directory, name, content);
    put(directory, 0, 2);  // no comment
    put(directory, 0, 2);  // first disk
    put(directory, 0, 2);  // internal attributes
    put(directory, 0, 4);  // external attributes
    put(directory, offset, 4);
    directory += name;
  }
  const auto directory_at = static_cast<std::uint32_t>(out.size());
  out += directory;
  put(out, 0x06054b50, 4);
  put(out, 0, 2);
  put(out, 0, 2);
  put(out, static_cast<std::uint32_t>(files.size()), 2);
  put(out, static_cast<std::uint32_t>(files.size()), 2);
  put(out, static_cast<std::uint32_t>(directory.size()), 4);
  put(out, directory_at, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace talus
