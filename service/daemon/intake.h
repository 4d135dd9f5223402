// The intake thread: requests and instrument samples from outside, checked, on their way to the simulation thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "service/daemon/channels.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"

namespace bleedsim::daemon {

class Intake {
 public:
  static Result<std::unique_ptr<Intake>> create(const transport::Participant& participant, const std::string& session,
                                                Channels& channels);

  /// Takes samples until requestStop(). A status other than ok: the middleware failed.
  Status run();
  /// From any thread.
  void requestStop();

  /// One sample each; run() calls them, tests may do so without any middleware thread.
  void takeRequest(const bleed_v1_Request& sample, transport::PublicationHandle writer);
  void takeInstrument(const bleed_v1_Instrument& sample, transport::PublicationHandle writer);

 private:
  struct Ends {
    transport::Reader<bleed_v1_Request> requests;
    transport::Reader<bleed_v1_Instrument> instruments;
    transport::GuardCondition stop;
    transport::WaitSet wait_set;
  };

  Intake(Ends ends, Channels& channels) : ends_{std::move(ends)}, channels_{channels} {}

  Status drain();
  void noticeLostWriters();
  void tellOfLostWriters();
  /// The participant of a writer; it alone may know whether two writers are one client's.
  template <class T>
  std::uint64_t senderOf(const transport::Reader<T>& reader, transport::PublicationHandle writer);
  dds::Reply replyTo(const dds::RequestKey& key, std::int64_t received) const;
  void noteResent(const dds::RequestKey& key);
  void refuse(dds::Reply reply, const Status& why);
  void send(dds::Reply reply);

  Ends ends_;
  Channels& channels_;
  std::map<transport::PublicationHandle, std::uint64_t> senders_;  // of the writers there are
  std::vector<WriterLost> lost_;                                   // that the simulation was not told of yet
};

}  // namespace bleedsim::daemon
