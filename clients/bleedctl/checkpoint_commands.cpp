// checkpoint, restore and checkpoints: states that a session can return to.
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/core.h>
#include <memory>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/json.h"
#include "service/status/checkpoint_name.h"

namespace bleedsim::bleedctl {
namespace {

client::SessionOptions commandsOnly() { return {.delivery = client::Delivery::none}; }

std::string nameProblem(const std::string& name) { return checkCheckpointName(name).message(); }

int runCheckpoint(const Context& context, const std::string& name) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, commandsOnly(), code);
  if (!connection) return code;
  const client::Reply reply = connection->session.checkpoint(name).get();
  return finish(context, reply, fmt::format("checkpoint '{}' kept", reply.object_name));
}

int runRestore(const Context& context, const std::string& name) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, commandsOnly(), code);
  if (!connection) return code;
  const client::Reply reply = connection->session.restore(name).get();
  return finish(context, reply, fmt::format("returned to checkpoint '{}'", reply.object_name));
}

std::string timeText(std::int64_t realtime_ns) {
  const auto seconds = static_cast<std::time_t>(realtime_ns / 1'000'000'000);
  std::tm parts{};
  if (localtime_r(&seconds, &parts) == nullptr) return "?";
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", parts);
}

int runCheckpoints(const Context& context) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, commandsOnly(), code);
  if (!connection) return code;
  const auto any = [](const client::SessionStatus&) { return true; };
  const Result<client::SessionStatus> status = connection->session.waitStatus(any, context.timeout());
  if (!status) return fail(status.status());
  if (context.json) {
    JsonArray array;
    for (const client::CheckpointInfo& info : status->checkpoints) {
      JsonObject json;
      json.add("name", info.name).add("own", info.own).add("epoch", info.epoch).add("step", info.step);
      json.add("sim_time_s", info.sim_time_s).add("bytes", info.bytes);
      array.raw(json.add("taken_ns", static_cast<std::uint64_t>(info.realtime_stamp_ns)).text());
    }
    fmt::print("{}\n", array.text());
    return kDone;
  }
  if (status->checkpoints.empty()) fmt::print(stderr, "session '{}' has no checkpoints\n", status->name);
  for (const client::CheckpointInfo& info : status->checkpoints) {
    fmt::print("{:<24} {:>10.3f} s  step {:>9}  epoch {:>3}  {:>8.1f} kB  {}{}\n", info.name, info.sim_time_s, info.step,
               info.epoch, static_cast<double>(info.bytes) * 1e-3, timeText(info.realtime_stamp_ns),
               info.own ? "" : "  of a daemon before this one");
  }
  return kDone;
}

}  // namespace

void addCheckpointCommands(CLI::App& app, Context& context) {
  const auto name = std::make_shared<std::string>();
  CLI::App* save = app.add_subcommand("checkpoint", "Keep the session's whole state; bleedd needs --checkpoint-dir");
  save->add_option("NAME", *name, "Letters, digits, '-' or '_', at most 48; without it, bleedd names it and keeps the last 3")
      ->check([](const std::string& text) { return nameProblem(text); })
      ->type_name("");
  save->callback([&context, name] { context.action = [&context, name] { return runCheckpoint(context, *name); }; });

  const auto from = std::make_shared<std::string>();
  CLI::App* restore = app.add_subcommand("restore", "Return to a checkpoint: a new epoch goes on from there");
  restore->add_option("NAME", *from, "As 'checkpoints' lists it; without it, the newest one")
      ->check([](const std::string& text) { return nameProblem(text); })
      ->type_name("");
  restore->callback([&context, from] { context.action = [&context, from] { return runRestore(context, *from); }; });

  app.add_subcommand("checkpoints", "List the checkpoints that a session can return to")->callback([&context] {
    context.action = [&context] { return runCheckpoints(context); };
  });
}

}  // namespace bleedsim::bleedctl
