// The running daemon: its threads and how they start and end.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "service/daemon/channels.h"
#include "service/daemon/checkpoint_keeper.h"
#include "service/daemon/intake.h"
#include "service/daemon/publisher.h"
#include "service/daemon/simulation.h"
#include "service/daemon/supervisor.h"

namespace bleedsim::daemon {

struct ServiceOptions {
  transport::ParticipantOptions participant;
  std::string session = transport::kDefaultSession;
  SimulationOptions simulation;
  std::shared_ptr<checkpoint::Folder> checkpoints = {};  ///< null: none are kept
  ServiceManager manager;
};

class Service {
 public:
  /// Joins the domain, makes sure that the session name is free, and puts the scene in place. unavailable: the name is taken;
  /// invalid_argument: the domain or the interface does not exist.
  static Result<std::unique_ptr<Service>> create(const ServiceOptions& options, LoadedScene first, SceneFactory factory);

  /// Runs the simulation on this thread until a shutdown request, the end of the duration or requestStop(). unavailable: another
  /// daemon that started at the same time keeps the name.
  Status run();
  /// From any thread, also before run().
  void requestStop() { simulation_->requestStop(); }

  const dds::SessionIdentity& identity() const { return identity_; }

 private:
  explicit Service(dds::SessionIdentity identity) : identity_{std::move(identity)} {}
  void endWith(const Status& why);

  dds::SessionIdentity identity_;
  Channels channels_;
  std::unique_ptr<CheckpointKeeper> keeper_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Intake> intake_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Supervisor> supervisor_;
  std::mutex mutex_;
  Status outcome_;  // guarded
};

/// Who this process is in `session`: a uuid drawn now, version, build, host and process.
dds::SessionIdentity makeIdentity(const std::string& session);

}  // namespace bleedsim::daemon
