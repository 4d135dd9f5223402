// A recording with its frames as foxglove.PointCloud; statistics, status, scene and journal go along, for plots beside them.

#include <set>

#include "service/recording/export_job.h"
#include "service/recording/mcap_writer.h"
#include "service/recording/point_cloud.h"
#include "service/recording/schemas.h"

namespace bleedsim::recording {
namespace {

/// In the place of the frames' own.
constexpr std::uint16_t kPointsId = channelIdOf(Topic::frame);

Result<mcap::McapWriter> openFile(const std::filesystem::path& path) {
  std::vector<mcap::Schema> schemas = recordingSchemas();
  std::vector<mcap::Channel> channels = recordingChannels();
  for (mcap::Schema& schema : schemas) {
    if (schema.id == kPointsId) schema = pointCloudSchema(kPointsId);
  }
  for (mcap::Channel& channel : channels) {
    if (channel.id == kPointsId) channel = pointCloudChannel(kPointsId, kPointsId);
  }
  mcap::ChunkOptions options;
  options.age = std::chrono::hours{1};  // nothing is lost here by a crash
  return mcap::McapWriter::open(path, options, std::move(schemas), std::move(channels));
}

class PointCloudExport {
 public:
  PointCloudExport(const ExportJob& job, mcap::McapWriter& file)
      : job_{job}, file_{file}, wanted_{job.frames.begin(), job.frames.end()} {}

  Result<ExportReport> run();

 private:
  ::bleedsim::Status add(const RecordedMessage& message);
  ::bleedsim::Status addFrame(const RecordedMessage& message);

  const ExportJob& job_;
  mcap::McapWriter& file_;
  const std::set<std::size_t> wanted_;
  ExportReport report_;
  std::size_t number_ = 0;  ///< of the next frame
  bool ended_ = false;
  std::string frame_id_;
  // Kept for their memory.
  Frame frame_;
  foxglove::PointCloud cloud_;
  std::string bytes_;
};

::bleedsim::Status PointCloudExport::addFrame(const RecordedMessage& message) {
  if (!wanted_.contains(number_++)) return {};
  if (::bleedsim::Status status = decode(message, frame_); !status) return status;
  if (::bleedsim::Status status = toPointCloud(frame_, frame_id_, cloud_); !status) return status;
  if (!cloud_.SerializeToString(&bytes_)) return {StatusCode::internal, "a message could not be serialised"};
  if (::bleedsim::Status status = file_.write(kPointsId, message.log_time_ns, message.publish_time_ns, bytes_); !status) {
    return status;
  }
  ended_ = !job_.goOn(report_);
  // Here the disk may take its time.
  return file_.flush();
}

::bleedsim::Status PointCloudExport::add(const RecordedMessage& message) {
  if (message.topic == Topic::frame) return addFrame(message);
  if (message.topic == Topic::scene) {
    Scene scene;
    if (::bleedsim::Status status = decode(message, scene); !status) return status;
    frame_id_ = scene.frame_id();
  }
  const std::string_view data{reinterpret_cast<const char*>(message.data.data()), message.data.size()};
  return file_.write(channelIdOf(message.topic), message.log_time_ns, message.publish_time_ns, data);
}

Result<ExportReport> PointCloudExport::run() {
  job_.reader.rewind();
  while (!ended_) {
    RecordedMessage message;
    const Result<bool> more = job_.reader.next(message);
    if (!more) return more.status();
    if (!*more) break;
    if (::bleedsim::Status status = add(message); !status) return status;
  }
  return report_;
}

}  // namespace

Result<ExportReport> exportPointCloud(const ExportJob& job) {
  Result<mcap::McapWriter> file = openFile(job.output);
  if (!file) return file.status();
  Result<ExportReport> report = PointCloudExport{job, *file}.run();
  if (!report) return report;
  if (::bleedsim::Status status = file->close(); !status) return status;
  report->bytes = file->bytes();
  return report;
}

}  // namespace bleedsim::recording
