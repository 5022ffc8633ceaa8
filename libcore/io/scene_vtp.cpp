// libcore/io/scene_vtp.cpp
// A scene as PolyData of VTK (XML, raw appended numbers): one moment for ParaView and VTK.
#include "base/text.hpp"
#include "io/scene_triangles.hpp"

namespace talus {
namespace {

// The arrays of a file: their XML, and their bytes one after the other, each after its length.
struct Appended {
  std::string bytes;

  template <class Fill>
  std::string array(const char* type, const std::string& name, int n_components, Fill fill) {
    const std::string xml = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                            "\" NumberOfComponents=\"" + std::to_string(n_components) +
                            "\" format=\"appended\" offset=\"" + std::to_string(bytes.size()) +
                            "\"/>\n";
    std::string numbers;
    fill(numbers);
    append(bytes, static_cast<std::uint64_t>(numbers.size()));
    bytes += numbers;
    return xml;
  }
};

}  // namespace

void write_vtp(const std::string& path, const BlockScene& scene) {
  const SceneTriangles all = triangles_of(scene);
  Appended data;
  const auto of_points = [&all](std::string& bytes) {
    for (const Vec3& p : all.points)
      for (const double x : p) append(bytes, x);
  };
  const auto of_cells = [&all](const auto& number) {
    return [&all, &number](std::string& bytes) {
      std::int64_t n = 0;
      for (const SceneTriangle& t : all.triangles) append(bytes, number(t, n++));
    };
  };
  const auto corners = [](const SceneTriangle& t, std::int64_t) {
    return std::array<std::int64_t, 3>{t.corners[0], t.corners[1], t.corners[2]};
  };
  const auto end = [](const SceneTriangle&, std::int64_t n) { return 3 * (n + 1); };
  const auto block = [](const SceneTriangle& t, std::int64_t) { return t.block; };
  const auto speed = [](const SceneTriangle& t, std::int64_t) { return t.speed; };
  const auto volume = [](const SceneTriangle& t, std::int64_t) { return t.volume; };
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">" +
      text(scene.time) + "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" +
      std::to_string(all.points.size()) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      std::to_string(all.triangles.size()) + "\">\n<Points>\n";
  xml += data.array("Float64", "Points", 3, of_points) + "</Points>\n<Polys>\n";
  xml += data.array("Int64", "connectivity", 1, of_cells(corners));
  xml += data.array("Int64", "offsets", 1, of_cells(end)) + "</Polys>\n";
  xml += "<CellData Scalars=\"speed_m_s\">\n";
  xml += data.array("Int32", "block", 1, of_cells(block));
  xml += data.array("Float32", "speed_m_s", 1, of_cells(speed));
  xml += data.array("Float32", "volume_m3", 1, of_cells(volume)) + "</CellData>\n";
  write_scene(path, xml + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + data.bytes +
                        "\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace talus
