#include "service/recording/export.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/core.h>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "service/recording/file_sink.h"
#include "service/recording/frame_layout.h"

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

std::string nameOf(Attribute::Semantic semantic) {
  switch (semantic) {
    case Attribute::POSITION:
      return "position";
    case Attribute::ID:
      return "id";
    case Attribute::VELOCITY:
      return "velocity";
    case Attribute::RADIUS:
      return "radius";
    case Attribute::PLATELET:
      return "platelet";
    case Attribute::VISCOSITY:
      return "viscosity";
    case Attribute::DENSITY:
      return "density";
    default:
      return fmt::format("attribute_{}", static_cast<int>(semantic));
  }
}

Array arrayOf(const AttributeBlock& block) {
  const Attribute& attribute = *block.attribute;
  Array array{nameOf(attribute.semantic()), "Float32", attribute.components(), {}, block.bytes};
  if (attribute.scalar_type() == Attribute::UINT32) array.type = "UInt32";
  if (attribute.scalar_type() == Attribute::UINT16) {
    const std::size_t count = block.bytes.size() / sizeof(std::uint16_t);
    array.converted.resize(count * sizeof(float));
    for (std::size_t i = 0; i < count; ++i) {
      std::uint16_t stored = 0;
      std::memcpy(&stored, block.bytes.data() + i * sizeof stored, sizeof stored);
      const float value = attribute.offset() + attribute.scale() * static_cast<float>(stored);
      std::memcpy(array.converted.data() + i * sizeof value, &value, sizeof value);
    }
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

::bleedsim::Status writeFile(const std::filesystem::path& path, const std::string& content) {
  Result<FileSink> sink = FileSink::open(path);
  if (!sink) return sink.status();
  const ::bleedsim::Status written = sink->write(content);
  const ::bleedsim::Status closed = sink->closeQuickly();
  return written ? closed : written;
}

/// Times of the collection rise through resets: an epoch goes on where the one before ended.
class Timeline {
 public:
  double at(const Frame& frame) {
    const std::pair<std::string, std::uint32_t> epoch{frame.session(), frame.epoch()};
    if (started_ && epoch != epoch_) offset_ = last_;
    started_ = true;
    epoch_ = epoch;
    last_ = offset_ + frame.sim_time_s();
    return last_;
  }

 private:
  bool started_ = false;
  std::pair<std::string, std::uint32_t> epoch_;
  double offset_ = 0.0;
  double last_ = 0.0;
};

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

Result<ExportReport> exportVtp(RecordingReader& reader, const std::filesystem::path& directory, const ExportProgress& progress) {
  Result<std::size_t> total = reader.frameCount();
  if (!total) return total.status();
  if (*total == 0) return ::bleedsim::Status{StatusCode::not_found, "the recording holds no frames to export"};
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    return ::bleedsim::Status{StatusCode::io, fmt::format("cannot create directory '{}': {}; choose one that you may write",
                                                          directory.string(), error.message())};
  }

  ExportReport report;
  report.collection = directory / "recording.pvd";
  const std::size_t digits = std::max<std::size_t>(6, std::to_string(*total - 1).size());
  std::string entries;
  Timeline timeline;
  Frame frame;
  for (std::size_t i = 0; i < *total; ++i) {
    if (::bleedsim::Status status = reader.frame(i, frame); !status) return status;
    Result<std::string> vtp = toVtp(frame);
    if (!vtp) return vtp.status();
    const std::string name = fmt::format("frame_{:0{}}.vtp", i, digits);
    if (::bleedsim::Status status = writeFile(directory / name, *vtp); !status) return status;
    entries += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", timeline.at(frame), name);
    ++report.frames;
    report.bytes += vtp->size();
    if (progress && !progress(report.frames, *total)) break;
  }
  const std::string collection =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n" +
      entries + "</Collection>\n</VTKFile>\n";
  if (::bleedsim::Status status = writeFile(report.collection, collection); !status) return status;
  report.bytes += collection.size();
  return report;
}

}  // namespace bleedsim::recording
