// libcore/io/errors_gdal.hpp: public
// Keeps GDAL from printing and holds its messages for our own.
#pragma once

#include <string>

namespace talus {

/// While it lives, GDAL's and PROJ's complaints of this thread are collected instead of printed.
/// The first one fixes the settings of these libraries (library_settings_gdal.hpp).
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  [[nodiscard]] bool failed() const { return !failure_.empty(); }
  /// The first failure, without a full stop at its end; empty when there was none.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// The first warning, likewise.
  [[nodiscard]] const std::string& warning() const { return warning_; }
  /// Throws InputError for a file that was not written, or not without a failure; it says the
  /// likely cause: the folder, or the disk.
  void check_written(const std::string& path, bool is_written) const;
  void note(bool is_failure, bool is_warning, const char* message);  ///< called by GDAL

 private:
  std::string failure_, warning_;
};

/// All drivers, once. GDAL's cache of blocks gets 128 MB unless GDAL_CACHEMAX says otherwise: its
/// default is a twentieth of the machine, which a pass over a large raster would fill. Throws
/// InputError when PROJ finds no proj.db.
void register_gdal_drivers();

}  // namespace talus
