// libcore/report/encode.hpp: public
// Text and numbers as the parts of a self-contained page: base64, data addresses.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Base64 with padding (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);
/// Numbers as little-endian bytes in base64.
[[nodiscard]] std::string base64(const std::vector<float>& values);
[[nodiscard]] std::string base64(const std::vector<std::uint32_t>& values);
[[nodiscard]] std::string base64(const std::vector<std::uint16_t>& values);

/// "data:TYPE;base64,..." of a file's content.
[[nodiscard]] std::string data_address(const std::string& media_type, std::string_view bytes);

/// A JSON string in its quotes that may also be inside an HTML script element.
[[nodiscard]] std::string json_string(std::string_view text);

}  // namespace talus
