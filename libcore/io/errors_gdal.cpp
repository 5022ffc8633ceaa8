// Starts GDAL with fixed settings, collects its messages instead of printing them, and turns failed
// writes into InputError.
#include "io/errors_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "base/error.hpp"
#include "io/library_settings_gdal.hpp"
#include "io/network_gdal.hpp"

namespace talus {
namespace {

void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* message) {
  static_cast<GdalErrors*>(CPLGetErrorHandlerUserData())
      ->note(severity == CE_Failure || severity == CE_Fatal, severity == CE_Warning, message);
}

// Without it coordinate systems are read by halves, and outputs differ from those of other
// machines.
void check_proj_database() {
  const GdalErrors quiet;
  if (OGRSpatialReference().importFromEPSG(4326) != OGRERR_NONE)
    throw InputError({"proj.db"}, "PROJ's database of coordinate systems cannot be found or read",
                     "install the package proj-data, or set PROJ_LIB to the folder that holds it");
}

// GDAL 3.10 writes a file of metadata beside a GeoPackage that is read, unless its metadata are
// read first, without such files.
GDALDataset* (*open_geopackage)(GDALOpenInfo*) = nullptr;
GDALDataset* open_without_file_beside(GDALOpenInfo* info) {
  const CPLConfigOptionSetter no_file_beside("GDAL_PAM_ENABLED", "NO", false);
  GDALDataset* const dataset = open_geopackage(info);
  if (dataset != nullptr) dataset->GetMetadata();
  return dataset;
}
void leave_geopackages_alone() {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (driver == nullptr) return;
  open_geopackage = driver->pfnOpen;
  driver->pfnOpen = open_without_file_beside;
}

}  // namespace

GdalErrors::GdalErrors() {
  fix_library_settings();
  CPLPushErrorHandlerEx(collect, this);
  CPLErrorReset();
}

GdalErrors::~GdalErrors() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void GdalErrors::note(bool is_failure, bool is_warning, const char* message) {
  if (!is_failure && !is_warning) return;
  std::string& kept = is_failure ? failure_ : warning_;
  if (!kept.empty()) return;
  kept = message;
  while (!kept.empty() && (kept.back() == '.' || kept.back() == '\n')) kept.pop_back();
  if (kept.empty()) kept = "GDAL complained without saying why";
}

void register_gdal_drivers() {
  static const bool once = [] {
    fix_library_settings();
    GDALAllRegister();
    forbid_network();
    leave_geopackages_alone();
    check_proj_database();
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr) GDALSetCacheMax64(128 << 20);
    return true;
  }();
  static_cast<void>(once);
}

void GdalErrors::check_written(const std::string& path, bool is_written) const {
  if (is_written && !failed()) return;
  std::string hint = "is the disk full, or its quota used up?";
  for (const char* words : {"No such file", "ermission denied", "Read-only", "not permitted"})
    if (failure_.find(words) != std::string::npos)
      hint = "the folder takes no new files: name another output";
  throw InputError({path}, "cannot be written: " + failure_, hint);
}

}  // namespace talus
