// libcore/import/canonical_gdal.hpp: public
// The file of imported data, in metres, x to the east, y to the north, z in one system of heights,
// with the decisions of the import.
// in:    layers that were read
// out:   a sealed GeoPackage; requests that read it without a question
#pragma once

#include <optional>
#include <string>

#include "import/import_inputs_gdal.hpp"
#include "import/layer_reading.hpp"
#include "import/request.hpp"

namespace talus {

/// Layers contours or points, breaklines, spots and boundary, those of objects on the ground
/// (RequestedLayer::layer), and the tables `sources`, `decisions` and `magnitudes`.
/// `source_feature` is the id of a line in the file that it comes from. The same inputs and reading
/// give the same bytes. Throws InputError when it cannot be written.
void write_canonical(const std::string& path, const InputsRequest& request, const Imported& inputs,
                     const ImportReading& reading);

/// The request for the ground of such a file; nothing for another one, a layer of it that is named,
/// or one without a ground. import_map() refuses it where it was changed since. Throws InputError
/// where the files that it was made from have changed.
[[nodiscard]] std::optional<InputsRequest> canonical_request(const std::string& path);

/// The part of such a file for a section of a site.
struct CanonicalLayer {
  std::string path;  ///< for read_vectors()
  std::string seal;  ///< digest_of() the data read from there; another one: changed_since()
};

/// The part of the file for the layer, section, file and digest of `wanted`, which is to be taken
/// to `crs`. Nothing where it does not hold the section, holds it of another file, or is in another
/// system: the named file is read itself then. Throws InputError where the digests differ, and for
/// a file that talus-import did not write.
[[nodiscard]] std::optional<CanonicalLayer> canonical_layer(const std::string& path,
                                                            const RequestedLayer& wanted,
                                                            const std::string& crs);

}  // namespace talus
