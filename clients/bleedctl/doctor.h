// What "bleedctl doctor" knows of host and domain, and what it makes of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bleedsim/types.h"
#include "clients/bleedctl/context.h"
#include "clients/bleedctl/host_clock.h"
#include "service/transport/discovery.h"
#include "service/transport/domain_config.h"
#include "service/transport/interfaces.h"

namespace bleedsim::bleedctl {

/// One session, as far as it answered.
struct SessionFacts {
  client::SessionStatus status;
  std::optional<client::SceneInfo> scene;
  std::optional<double> round_trip_s;         ///< of a ping; nothing: it did not answer
  std::optional<ClockDifference> difference;  ///< the same
  bool frame_came = false;
  std::size_t particle_bytes = 0;  ///< of a frame; 0: none came that has particles
};

struct DoctorFacts {
  std::string version;      ///< of bleedctl
  std::string dds_version;  ///< of Cyclone DDS
  std::string host;
  std::uint32_t domain = 0;
  std::string asked_interface;  ///< --interface
  std::string asked_session;    ///< --session
  std::optional<transport::DomainConfig> config;
  std::string domain_problem;  ///< why the domain could not be joined; empty: it was
  std::vector<transport::NetworkInterface> interfaces;
  std::size_t receive_limit = 0;  ///< bytes; 0: not known
  std::optional<ClockState> clock;
  transport::DomainView others;  ///< without this process
  std::vector<SessionFacts> sessions;
};

enum class Severity { ok, note, problem };
const char* toString(Severity severity);

struct Finding {
  Severity severity = Severity::ok;
  const char* area = "";
  std::string text;
  std::string remedy;  ///< what to do: of problems and notes
};

/// Reads host and domain; takes some seconds.
DoctorFacts gatherFacts(const Context& context);

/// What the facts say, area by area.
std::vector<Finding> diagnose(const DoctorFacts& facts);

}  // namespace bleedsim::bleedctl
