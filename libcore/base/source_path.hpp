// libcore/base/source_path.hpp: public
// The name of a source as people, QGIS and download sites write it, split into the file and its
// part:
// "map.gpkg|layername=index|subset=ELEV > 900", "map.zip", "/vsizip/map.zip/sheet.shp".
#pragma once

#include <string>

namespace talus {

struct SourcePath {
  std::string file;    ///< that the file system knows; a virtual path of GDAL without one stays
  std::string source;  ///< name that GDAL opens: "map.gpkg", "/vsizip/map.zip/sheet.shp"
  std::string inside;  ///< rest of the name after `file`, as it is written; may be empty
  std::string layer, layer_id, subset;  ///< of a name as QGIS writes it
};

/// A name that a file has is that file, whatever signs it contains. Throws InputError for a part
/// "|key=" that is not known.
[[nodiscard]] SourcePath parse_source_path(const std::string& name);

/// "map.zip/sheet.shp" of "map.zip/sheet.shp|layername=a": the name of a source in messages that
/// name its layer apart.
[[nodiscard]] std::string without_layer(const std::string& name);

/// The source as words of a command like ogr2ogr, quoted for the shell where needed: for hints that
/// hold a command.
[[nodiscard]] std::string command_words(const std::string& name);

/// A word of a command, quoted where something in it means something to a shell.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The prefix by which GDAL looks into an archive ("/vsizip/"); empty when it is none by its name.
[[nodiscard]] std::string archive_prefix(const std::string& file);

/// Whether a file of this name is read as a table of points: .csv, .tsv, .txt, .xyz, .pts.
[[nodiscard]] bool is_table_name(const std::string& path);

}  // namespace talus
