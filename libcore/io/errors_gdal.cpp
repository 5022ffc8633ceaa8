#include "io/errors_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

namespace talus {
namespace {

void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* message) {
  static_cast<GdalErrors*>(CPLGetErrorHandlerUserData())
      ->note(severity == CE_Failure || severity == CE_Fatal, message);
}

}  // namespace

GdalErrors::GdalErrors() {
  CPLPushErrorHandlerEx(collect, this);
  CPLErrorReset();
}

GdalErrors::~GdalErrors() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void GdalErrors::note(bool is_failure, const char* message) {
  if (!is_failure || failed()) return;
  failure_ = message;
  while (!failure_.empty() && (failure_.back() == '.' || failure_.back() == '\n'))
    failure_.pop_back();
  if (failure_.empty()) failure_ = "GDAL failed without saying why";
}

void register_gdal_drivers() {
  static const bool once = [] {
    GDALAllRegister();
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr) GDALSetCacheMax64(128 << 20);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace talus
