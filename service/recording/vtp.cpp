#include "service/recording/vtp.h"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/core.h>
#include <utility>
#include <vector>

#include "service/recording/export_job.h"
#include "service/recording/frame_layout.h"
#include "service/recording/write_file.h"

namespace bleedsim::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "the blocks are copied as they are");

/// One array of the appended section.
struct Array {
  std::string name;
  const char* type = "Float32";
  std::uint32_t components = 1;
  std::string converted;  ///< bytes of scaled arrays; empty: `bytes`
  std::span<const char> bytes;

  std::span<const char> data() const { return converted.empty() ? bytes : std::span<const char>{converted}; }
};

Array arrayOf(const AttributeBlock& block) {
  const Attribute& attribute = *block.attribute;
  Array array{nameOf(attribute.semantic()), "Float32", attribute.components(), {}, block.bytes};
  if (attribute.scalar_type() == Attribute::UINT32) array.type = "UInt32";
  if (attribute.scalar_type() == Attribute::UINT16) {
    std::vector<float> values;
    readFloats(block, values);
    array.converted.assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  }
  return array;
}

/// One vertex cell per point: without cells ParaView draws nothing.
Array vertexArray(const char* name, std::uint32_t count, std::int64_t first) {
  Array array{name, "Int64", 1, {}, {}};
  array.converted.resize(std::size_t{count} * sizeof(std::int64_t));
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::int64_t value = first + i;
    std::memcpy(array.converted.data() + std::size_t{i} * sizeof value, &value, sizeof value);
  }
  return array;
}

std::string declare(const Array& array, std::uint64_t& offset) {
  std::string line = fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                                 array.type, array.name, array.components, offset);
  offset += sizeof(std::uint64_t) + array.data().size();
  return line + "\n";
}

}  // namespace

Result<std::string> toVtp(const Frame& frame) {
  Result<std::vector<AttributeBlock>> blocks = layoutOf(frame);
  if (!blocks) return blocks.status();
  std::vector<Array> points;
  std::vector<Array> attributes;
  for (const AttributeBlock& block : *blocks) {
    std::vector<Array>& list = block.attribute->semantic() == Attribute::POSITION ? points : attributes;
    list.push_back(arrayOf(block));
  }
  points.resize(1);
  const std::array<Array, 2> cells{vertexArray("connectivity", frame.count(), 0), vertexArray("offsets", frame.count(), 1)};

  std::uint64_t offset = 0;
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
  out += fmt::format(
      "<PolyData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      frame.count());
  out += "<Points>\n" + declare(points.front(), offset) + "</Points>\n<PointData>\n";
  for (const Array& array : attributes) out += declare(array, offset);
  out += "</PointData>\n<Verts>\n";
  for (const Array& array : cells) out += declare(array, offset);
  out += "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  const auto append = [&](const Array& array) {
    const std::uint64_t size = array.data().size();
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    out.append(array.data().data(), array.data().size());
  };
  append(points.front());
  for (const Array& array : attributes) append(array);
  for (const Array& array : cells) append(array);
  out += "\n</AppendedData>\n</VTKFile>\n";
  return out;
}

Result<ExportReport> exportVtp(const ExportJob& job) {
  if (::bleedsim::Status status = createFolder(job.output); !status) return status;
  ExportReport report;
  report.output = job.output / "recording.pvd";
  std::string entries;
  Timeline timeline;
  Frame frame;
  for (const std::size_t number : job.frames) {
    if (::bleedsim::Status status = job.reader.frame(number, frame); !status) return status;
    const Result<std::string> vtp = toVtp(frame);
    if (!vtp) return vtp.status();
    const std::string name = job.fileName(number, "vtp");
    if (::bleedsim::Status status = writeFile(job.output / name, *vtp); !status) return status;
    entries += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", timeline.at(frame), name);
    report.bytes += vtp->size();
    if (!job.goOn(report)) break;
  }
  const std::string collection =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n" +
      entries + "</Collection>\n</VTKFile>\n";
  if (::bleedsim::Status status = writeFile(report.output, collection); !status) return status;
  report.bytes += collection.size();
  return report;
}

}  // namespace bleedsim::recording
