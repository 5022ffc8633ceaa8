// Writes a run for ParaView: XDMF 3 with the blocks' faces as polygons, frame by frame.
#include "store/xdmf_hdf5.hpp"

#include "base/text.hpp"
#include "base/write_bytes.hpp"
#include "io/h5_hdf5.hpp"

namespace talus {
namespace {

constexpr std::int32_t polygon = 3;  // XDMF's number of a polygon in a mixed topology

struct Faces {
  std::vector<std::int32_t> topology;  // 3, n, ids ... of each face
  std::vector<std::int32_t> block;     // of each face
};

Faces faces_of(const RunBlocks& blocks) {
  Faces faces;
  for (std::size_t b = 0; b + 1 < blocks.block_face_begin.size(); ++b)
    for (int f = blocks.block_face_begin[b]; f < blocks.block_face_begin[b + 1]; ++f) {
      const auto i = static_cast<std::size_t>(f);
      faces.topology.push_back(polygon);
      faces.topology.push_back(blocks.face_begin[i + 1] - blocks.face_begin[i]);
      for (int k = blocks.face_begin[i]; k < blocks.face_begin[i + 1]; ++k)
        faces.topology.push_back(blocks.face_vertices[k]);
      faces.block.push_back(static_cast<std::int32_t>(b));
    }
  return faces;
}

void write_frame(H5Writer& data, const RunFile& run, const Faces& faces, int k) {
  const RunBlocks& blocks = run.blocks;
  std::vector<float> points, speeds;
  std::vector<float> speed_of_block;
  for (int b = 0; b < n_blocks(run); ++b) {
    const FrameBlock block = frame_block(run, k, b);
    const Pose pose{block.position, block.attitude};
    const auto i = static_cast<std::size_t>(b);
    for (int v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v)
      for (const double x : place(pose, blocks.vertices[v]))
        points.push_back(static_cast<float>(x));
    speed_of_block.push_back(static_cast<float>(block.velocity.norm()));
  }
  for (const std::int32_t b : faces.block) speeds.push_back(speed_of_block[b]);
  const std::string group = "frame_" + std::to_string(k);
  data.group(group, "one frame");
  data.array<float>(group + "/points", points, {{"/vertex", points.size() / 3}, {"/axis", 3}}, "m",
                    "vertices, local");
  data.array<float>(group + "/speed", speeds, {{"/face", speeds.size()}}, "m/s",
                    "speed of the face's block");
}

std::string item(const std::string& dimensions, const char* type, const std::string& where) {
  return "<DataItem Dimensions=\"" + dimensions + "\" NumberType=\"" + type +
         "\" Precision=\"4\" Format=\"HDF\">" + where + "</DataItem>";
}

std::string described(const RunFile& run, const Faces& faces, const std::string& data_name) {
  const std::string n_faces = std::to_string(faces.block.size());
  const std::string n_points = std::to_string(run.blocks.vertices.size());
  std::string xml =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "<Grid Name=\"blocks\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (int k = 0; k < n_frames(run.frames); ++k) {
    const std::string frame = data_name + ":/frame_" + std::to_string(k);
    xml += "<Grid Name=\"blocks\" GridType=\"Uniform\"><Time Value=\"" + text(run.frames.time[k]) +
           "\"/>\n<Topology TopologyType=\"Mixed\" NumberOfElements=\"" + n_faces + "\">" +
           item(std::to_string(faces.topology.size()), "Int", data_name + ":/topology") +
           "</Topology>\n<Geometry GeometryType=\"XYZ\">" +
           item(n_points + " 3", "Float", frame + "/points") +
           "</Geometry>\n<Attribute Name=\"block\" AttributeType=\"Scalar\" Center=\"Cell\">" +
           item(n_faces, "Int", data_name + ":/block") +
           "</Attribute>\n<Attribute Name=\"speed_m_s\" AttributeType=\"Scalar\" Center=\"Cell\">" +
           item(n_faces, "Float", frame + "/speed") + "</Attribute>\n</Grid>\n";
  }
  return xml + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace

void write_xdmf(const std::string& path, const std::string& data_path, const std::string& data_name,
                const RunFile& run) {
  const Faces faces = faces_of(run.blocks);
  H5Writer data;
  data.attribute("", "description", std::string("Geometry of a run of talus-dda for XDMF"));
  data.attribute("", "origin_m", std::span<const double>(run.info.origin.data(), 3));
  data.array<std::int32_t>("topology", faces.topology, {{"entry", faces.topology.size()}}, "1",
                           "3, number of corners, corners ... of each face");
  data.array<std::int32_t>("block", faces.block, {{"face", faces.block.size()}}, "1",
                           "block of each face");
  for (int k = 0; k < n_frames(run.frames); ++k) write_frame(data, run, faces, k);
  data.save(data_path);
  const std::string xml = described(run, faces, data_name);
  write_bytes(path, {reinterpret_cast<const unsigned char*>(xml.data()), xml.size()});
}

}  // namespace talus
