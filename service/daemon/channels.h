// Everything that passes between the threads of the service. Each part is bounded and may be used by its two sides at once.
#pragma once

#include <cstddef>

#include "service/daemon/bounded_queue.h"
#include "service/daemon/client_ledger.h"
#include "service/daemon/command_queue.h"
#include "service/daemon/frame_mailbox.h"
#include "service/daemon/journal.h"
#include "service/daemon/pulse.h"
#include "service/daemon/reply_cache.h"
#include "service/daemon/service_counters.h"
#include "service/daemon/status_board.h"
#include "service/daemon/wakeup.h"
#include "service/dds/reply.h"

namespace bleedsim::daemon {

struct Channels {
  /// More than the command queue holds, so that a full queue can be answered at once.
  static constexpr std::size_t kReplyCapacity = 2 * CommandQueue::kCapacity;

  /// Wound commands that may wait for surface tension at once.
  static constexpr std::size_t kMaxWaitingWounds = 64;
  /// Of these, the intake leaves to the simulation: one for the request at hand, one for the load or the switch that may end at
  /// any time, one for the checkpoint that is being written, and those of the wounds that wait.
  static constexpr std::size_t kRepliesOfSimulation = 3 + kMaxWaitingWounds;

  CommandQueue commands;                             ///< intake -> simulation
  BoundedQueue<dds::Reply> replies{kReplyCapacity};  ///< simulation, intake -> publisher
  ReplyCache reply_cache;                            ///< intake asks, publisher remembers
  Journal journal;                                   ///< simulation -> publisher
  FrameMailbox frames;                               ///< simulation -> publisher
  StatusBoard board;                                 ///< simulation -> publisher, intake
  ServiceCounters counters;
  ClientLedger clients;    ///< intake, simulation -> publisher
  Wakeup publisher;        ///< the publisher waits here
  Pulse simulation_pulse;  ///< beats with every tick
  Pulse publisher_pulse;   ///< beats with every round
};

}  // namespace bleedsim::daemon
