// Switches off settings of GDAL and PROJ that would change the data read.
#include "io/library_settings_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <proj.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/network.hpp"

namespace talus {
namespace {

using Names = std::vector<std::string_view>;

// Settings of GDAL that cannot change a value: places of data, drivers and temporary files, memory.
const Names& kept_of_gdal() {
  static const Names names = {"GDAL_DATA",  "GDAL_DRIVER_PATH", "GDAL_CACHEMAX",
                              "CPL_TMPDIR", "TMPDIR",           "TEMP"};
  return names;
}

// How GDAL reaches files of a network; the names begin so.
const Names& network_of_gdal() {
  static const Names begins = {
      "AWS_",      "AZURE_",    "GS_",        "GOOGLE_",        "OSS_",          "SWIFT_", "OS_",
      "CPL_VSIL_", "CPL_CURL_", "GDAL_HTTP_", "CURL_CA_BUNDLE", "SSL_CERT_FILE", "HOME"};
  return begins;
}

// PROJ, SpatiaLite and a driver read the environment on their own.
bool is_of_others(const std::string& name) {
  static const Names kept = {"PROJ_DATA", "PROJ_LIB", "PROJ_USER_WRITABLE_DIRECTORY",
                             "PROJ_SKIP_READ_USER_WRITABLE_DIRECTORY"};
  const bool is_other =
      name.starts_with("PROJ_") || name.starts_with("SPATIALITE_") || name.starts_with("OGR_NTF_");
  return is_other && std::count(kept.begin(), kept.end(), name) == 0;
}

bool is_of_gdal(const std::string& name) {
  const Names &kept = kept_of_gdal(), &network = network_of_gdal();
  return std::count(kept.begin(), kept.end(), name) > 0 ||
         (network_is_allowed() &&
          std::any_of(network.begin(), network.end(),
                      [&name](std::string_view begin) { return name.starts_with(begin); }));
}

std::map<std::string, std::string> environment() {
  std::map<std::string, std::string> settings;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string words = *entry;
    const std::size_t equals = words.find('=');
    if (equals != std::string::npos) settings[words.substr(0, equals)] = words.substr(equals + 1);
  }
  return settings;
}

// PROJ's own defaults in place of the settings of a proj.ini (network, the algorithm of UTM); other
// files are found where PROJ looks for them.
const char* find_no_settings(PJ_CONTEXT* /*context*/, const char* name, void* /*data*/) {
  return std::strcmp(name, "proj.ini") == 0 ? "/dev/null" : nullptr;
}

// GDAL takes no setting from the environment once a file of settings says so, and looks for no
// other such file where one is named. GDAL 3.6 then calls itself without end for CPL_DEBUG.
void forget_gdal_settings() {
  unsetenv("CPL_DEBUG");
  static char only[] = "[directives]\nignore-env-vars=yes\n";
  constexpr const char* file = "/vsimem/talus_settings/gdalrc";
  VSIFCloseL(VSIFileFromMemBuffer(file, reinterpret_cast<GByte*>(only), sizeof only - 1, FALSE));
  CPLLoadConfigOptionsFromFile(file, TRUE);
  CPLSetConfigOption("GDAL_CONFIG_FILE", file);
}

}  // namespace

void fix_library_settings() {
  static const bool once = [] {
    forget_gdal_settings();
    for (const auto& [name, value] : environment()) {
      if (is_of_gdal(name)) CPLSetConfigOption(name.c_str(), value.c_str());
      if (is_of_others(name)) unsetenv(name.c_str());
    }
    proj_context_set_file_finder(nullptr, find_no_settings, nullptr);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace talus
