#include "io/foreign_hdf5.hpp"

#include <hdf5.h>

#include "base/error.hpp"

namespace talus {
namespace {

herr_t find_external_link(hid_t /*group*/, const char* name, const H5L_info_t* link, void* found) {
  if (link->type != H5L_TYPE_EXTERNAL) return 0;
  *static_cast<std::string*>(found) = name;
  return 1;
}

herr_t find_external_values(hid_t file, const char* name, const H5O_info_t* object, void* found) {
  if (object->type != H5O_TYPE_DATASET) return 0;
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  if (set < 0) return 0;
  const hid_t list = H5Dget_create_plist(set);
  const bool elsewhere = H5Pget_external_count(list) > 0 || H5Pget_layout(list) == H5D_VIRTUAL;
  H5Pclose(list);
  H5Dclose(set);
  if (!elsewhere) return 0;
  *static_cast<std::string*>(found) = name;
  return 1;
}

}  // namespace

std::string kept_in_another_file(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Fis_hdf5(path.c_str()) <= 0) return "";
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0)
    throw InputError({path}, "is an HDF5 file that cannot be opened",
                     "h5dump -H " + path + " shows what is wrong with it");
  std::string found;
  if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, find_external_link, &found) == 0)
    H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, find_external_values, &found);
  H5Fclose(file);
  return found;
}

}  // namespace talus
