#include "service/daemon/service.h"

#include <thread>
#include <unistd.h>
#include <utility>

#include "service/build/build_info.h"
#include "service/transport/clock.h"
#include "service/transport/host_name.h"

namespace bleedsim::daemon {
namespace {

// Discovery takes milliseconds on a healthy network; two daemons that start within the window settle it by their status.
constexpr std::chrono::milliseconds kListenWindow{400};

}  // namespace

dds::SessionIdentity makeIdentity(const std::string& session) {
  return {transport::drawUuid(), session, buildVersion(), buildId(), transport::hostName(), getpid(), transport::realtimeNow()};
}

Result<std::unique_ptr<Service>> Service::create(const ServiceOptions& options, LoadedScene first, SceneFactory factory) {
  if (Status name = transport::checkSessionName(options.session); !name) return name;
  const Result<transport::Participant> participant = transport::Participant::create(options.participant);
  if (!participant) {
    // An interface that is missing or down may come yet.
    const bool given_wrong = participant.status().code() == StatusCode::invalid_argument;
    return Status{given_wrong ? StatusCode::invalid_argument : StatusCode::io, participant.status().message()};
  }
  std::unique_ptr<Service> service{new Service{makeIdentity(options.session)}};

  Result<SessionGuard> guard = SessionGuard::create(*participant, service->identity_);
  if (!guard) return Status{StatusCode::io, guard.status().message()};
  const Result<std::optional<Rival>> rival = guard->listen(kListenWindow);
  if (!rival) return Status{StatusCode::io, rival.status().message()};
  if (*rival) return nameTaken(options.session, **rival);

  auto publisher = Publisher::create(*participant, service->identity_, service->channels_, std::move(*guard));
  if (!publisher) return Status{StatusCode::io, publisher.status().message()};
  auto intake = Intake::create(*participant, options.session, service->channels_);
  if (!intake) return Status{StatusCode::io, intake.status().message()};
  service->publisher_ = std::move(*publisher);
  service->intake_ = std::move(*intake);
  SimulationOptions simulation = options.simulation;
  if (options.checkpoints) {
    const dds::SessionIdentity& identity = service->identity_;
    Channels& channels = service->channels_;
    service->keeper_ =
        std::make_unique<CheckpointKeeper>(options.checkpoints, CheckpointOrigin{identity.build_id, identity.name, identity.uuid},
                                           channels.board, channels.commands.wakeup(), channels.publisher);
    simulation.keeper = service->keeper_.get();
  }
  service->simulation_ =
      std::make_unique<Simulation>(simulation, std::move(first), std::move(factory), service->channels_, Clock::now());
  service->supervisor_ = std::make_unique<Supervisor>(service->channels_, options.manager, Clock::now());
  return service;
}

void Service::endWith(const Status& why) {
  {
    const std::lock_guard lock{mutex_};
    if (outcome_) outcome_ = why;
  }
  requestStop();
}

Status Service::run() {
  supervisor_->start();
  std::thread publishing{[this] {
    const auto give_way = [this](const Rival& rival) { endWith(nameTaken(identity_.name, rival)); };
    publisher_->run(give_way, [this] { supervisor_->sessionShown(); });
  }};
  std::thread taking{[this] {
    if (const Status ended = intake_->run(); !ended) endWith({StatusCode::io, ended.message()});
  }};
  simulation_->run();
  supervisor_->stop();
  intake_->requestStop();
  taking.join();
  publisher_->requestStop();
  publishing.join();
  const std::lock_guard lock{mutex_};
  return outcome_;
}

}  // namespace bleedsim::daemon
