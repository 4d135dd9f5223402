#include "tests/integration/recording/stream_recorder.h"

#include <chrono>
#include <utility>

namespace bleedsim::recording_test {

namespace {

constexpr unsigned kSamples = 0;

template <class T>
Result<transport::Reader<T>> recorderOf(const transport::Participant& participant, const std::string& session) {
  return transport::Reader<T>::create(participant, session,
                                      transport::readerQos(transport::TopicTraits<T>::kTopic, transport::Reading::recorder));
}

/// Takes everything that is there; the first sample that cannot be stored ends it.
template <class T>
Status store(transport::Reader<T>& reader, recording::RecordingWriter& writer) {
  Status stored;
  for (;;) {
    const auto taken = reader.take([&](const transport::Sample<T>& sample) {
      if (sample.data != nullptr && stored) stored = writer.append(*sample.data);
    });
    if (!taken) return taken.status();
    if (!stored || *taken == 0) return stored;
  }
}

}  // namespace

StreamRecorder::StreamRecorder(recording::RecordingWriter writer, transport::WaitSet waits,
                               transport::Reader<bleed_v1_Frame> frames, transport::Reader<bleed_v1_FrameStats> stats,
                               transport::Reader<bleed_v1_Scene> scenes, transport::Reader<bleed_v1_Status> statuses,
                               transport::Reader<bleed_v1_Journal> journal)
    : writer_{std::move(writer)},
      frames_{std::move(frames)},
      stats_{std::move(stats)},
      scenes_{std::move(scenes)},
      statuses_{std::move(statuses)},
      journal_{std::move(journal)},
      waits_{std::move(waits)} {}

Result<StreamRecorder> StreamRecorder::create(const transport::Participant& participant, const std::string& session,
                                              const std::filesystem::path& file) {
  auto writer = recording::RecordingWriter::open(file);
  if (!writer) return writer.status();
  auto frames = recorderOf<bleed_v1_Frame>(participant, session);
  if (!frames) return frames.status();
  auto stats = recorderOf<bleed_v1_FrameStats>(participant, session);
  if (!stats) return stats.status();
  auto scenes = recorderOf<bleed_v1_Scene>(participant, session);
  if (!scenes) return scenes.status();
  auto statuses = recorderOf<bleed_v1_Status>(participant, session);
  if (!statuses) return statuses.status();
  auto journal = recorderOf<bleed_v1_Journal>(participant, session);
  if (!journal) return journal.status();
  auto waits = transport::WaitSet::create(participant);
  if (!waits) return waits.status();
  if (Status attached = waits->attach(*frames, kSamples); !attached) return attached;
  if (Status attached = waits->attach(*stats, kSamples); !attached) return attached;
  if (Status attached = waits->attach(*scenes, kSamples); !attached) return attached;
  if (Status attached = waits->attach(*statuses, kSamples); !attached) return attached;
  if (Status attached = waits->attach(*journal, kSamples); !attached) return attached;
  return StreamRecorder{std::move(*writer), std::move(*waits),    std::move(*frames), std::move(*stats),
                        std::move(*scenes), std::move(*statuses), std::move(*journal)};
}

Status StreamRecorder::drain() {
  if (Status stored = store(scenes_, writer_); !stored) return stored;
  if (Status stored = store(journal_, writer_); !stored) return stored;
  if (Status stored = store(statuses_, writer_); !stored) return stored;
  if (Status stored = store(frames_, writer_); !stored) return stored;
  return store(stats_, writer_);
}

Status StreamRecorder::recordUntil(const std::function<bool(const recording::WriterCounts&)>& done) {
  for (;;) {
    if (Status drained = drain(); !drained) return drained;
    if (done(writer_.counts())) return {};
    const auto woken = waits_.wait(std::chrono::seconds{20});
    if (!woken) return woken.status();
    if (woken->timedOut()) return {StatusCode::timed_out, "nothing arrived for 20 s although samples are missing"};
  }
}

}  // namespace bleedsim::recording_test
