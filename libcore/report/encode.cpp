// Text and numbers as the parts of a self-contained page: base64, data addresses.
#include "report/encode.hpp"

#include <array>
#include <bit>
#include <type_traits>

#include "base/printable.hpp"

namespace talus {
namespace {

template <class T>
std::string little_endian(const std::vector<T>& values) {
  using Bits = std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint32_t>;
  std::string bytes;
  bytes.reserve(sizeof(T) * values.size());
  for (const T value : values) {
    const std::uint32_t bits = std::bit_cast<Bits>(value);
    for (std::size_t k = 0; k < sizeof(T); ++k) bytes += static_cast<char>(bits >> (8 * k) & 255u);
  }
  return bytes;
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= n ? letters[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

std::string base64(const std::vector<float>& values) { return base64(little_endian(values)); }
std::string base64(const std::vector<std::uint32_t>& values) {
  return base64(little_endian(values));
}
std::string base64(const std::vector<std::uint16_t>& values) {
  return base64(little_endian(values));
}

std::string data_address(const std::string& media_type, std::string_view bytes) {
  return "data:" + media_type + ";base64," + base64(bytes);
}

std::string json_string(std::string_view text) {
  static constexpr std::string_view hex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : printable(text)) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += std::string("\\") + c;
    } else if (u < 32 || c == '<') {  // "<" could end the script element
      out += std::string("\\u00") + hex[u >> 4] + hex[u & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace talus
