// lease: keeps every other client from commanding for as long as it runs.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/stop_signal.h"
#include "service/status/number_text.h"
#include "service/status/request_limits.h"

namespace bleedsim::bleedctl {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr double kLongestHold = 86400.0;
// Short enough that a lease whose holder was killed before its goodbye is soon over, long enough to outlast a lost renewal or
// two.
constexpr std::chrono::seconds kLease{10};
constexpr std::chrono::seconds kRenewal{3};

int runLease(const Context& context, double seconds) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, {.delivery = client::Delivery::none}, code);
  if (!connection) return code;
  client::Session& session = connection->session;
  holdStopSignals();
  code = finish(context, session.acquireLease(kLease),
                seconds > 0.0 ? fmt::format("leased for {} s", seconds) : "leased until Ctrl-C");
  if (code != kDone) return code;
  std::fflush(stdout);

  const std::chrono::duration<double> wanted{seconds > 0.0 ? seconds : kLongestHold};
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(wanted);
  for (;;) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (left.count() <= 0 || waitForStopSignal(std::min<milliseconds>(kRenewal, left))) break;
    if (Clock::now() >= end) break;
    const client::Reply renewed = session.acquireLease(kLease).get();
    if (!renewed.accepted()) return finish(context, renewed, "");
  }
  return finish(context, session.releaseLease(), "released");
}

}  // namespace

void addLeaseCommand(CLI::App& app, Context& context) {
  CLI::App* lease = app.add_subcommand("lease", "Keep every other client from commanding, until Ctrl-C or for --seconds");
  lease->footer(
      "Commands of other clients, bleedctl's included, are refused and their instruments not used. Who wants to command while\n"
      "the others may not takes the lease in its own program (Session::acquireLease).\n");
  const auto seconds = std::make_shared<double>(0.0);
  lease->add_option("--seconds", *seconds, "Release it after this time; default: hold it until Ctrl-C, for a day at most")
      ->check(finiteIn(kMinLease, kLongestHold))
      ->type_name("S");
  lease->callback([&context, seconds] { context.action = [&context, seconds] { return runLease(context, *seconds); }; });
}

}  // namespace bleedsim::bleedctl
