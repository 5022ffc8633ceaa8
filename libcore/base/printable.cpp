// Escapes control, direction and invalid characters of foreign text.
#include "base/printable.hpp"

#include <cstdint>

namespace talus {
namespace {

// A character of UTF-8 at the beginning of a text.
struct Character {
  std::uint32_t code = 0;
  std::size_t n_bytes = 1;
  bool is_valid = false;
};

Character first_character(std::string_view text) {
  const auto byte = [&text](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t n = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || n > text.size()) return {lead};
  std::uint32_t code = lead & (0x7Fu >> n);
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return {lead};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_overlong = (n == 3 && code < 0x800) || (n == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (is_overlong || is_surrogate || code > 0x10FFFF) return {lead};
  return {code, n, true};
}

bool is_printable(std::uint32_t code) {
  if (code == '\n' || code == '\t') return true;
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;  // C0, delete, C1
  const bool turns_direction = code == 0x61C || code == 0x200E || code == 0x200F ||
                               (code >= 0x202A && code <= 0x202E) ||
                               (code >= 0x2066 && code <= 0x2069);
  const bool breaks_lines = code == 0x2028 || code == 0x2029;
  return !turns_direction && !breaks_lines && code != 0xFFFE && code != 0xFFFF;  // none of XML
}

std::string hexadecimal(std::uint32_t code, int n_digits) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out;
  for (int shift = 4 * (n_digits - 1); shift >= 0; shift -= 4) out += digits[code >> shift & 15u];
  return out;
}

std::string with_escapes(std::string_view text, bool as_json) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.is_valid && is_printable(c.code))
      out += text.substr(0, c.n_bytes);
    else if (as_json || c.code > 0xFF)
      out += "\\u" + (c.is_valid ? hexadecimal(c.code, 4) : "fffd");
    else
      out += "\\x" + hexadecimal(c.code, 2);
    text.remove_prefix(c.n_bytes);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return with_escapes(text, false); }

std::string printable_json(std::string_view json) { return with_escapes(json, true); }

}  // namespace talus
