// pause, resume, reset, step, pace, load and shutdown.
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "clients/bleedctl/context.h"
#include "service/status/pace_text.h"
#include "service/status/request_limits.h"

namespace bleedsim::bleedctl {
namespace {

using client::Session;

constexpr std::chrono::milliseconds kLook{50};

client::SessionOptions commandsOnly() { return {.delivery = client::Delivery::none}; }

/// Adds a command that sends one request without arguments.
void addPlain(CLI::App& app, Context& context, const std::string& name, const std::string& help, const std::string& done,
              std::future<client::Reply> (Session::*request)()) {
  app.add_subcommand(name, help)->callback([&context, done, request] {
    context.action = [&context, done, request] {
      int code = kDone;
      std::optional<Connection> connection = connect(context, commandsOnly(), code);
      return connection ? finish(context, (connection->session.*request)(), done) : code;
    };
  });
}

Result<std::string> readScene(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return Status{StatusCode::io, fmt::format("'{}' is a folder: give a .textproto scene in it", path)};
  }
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return Status{StatusCode::io, fmt::format("'{}' is not a regular file: give a .textproto scene", path)};
  }
  std::ifstream file{path, std::ios::binary};
  if (!file) return Status{StatusCode::io, fmt::format("could not read '{}': check the path and its permissions", path)};
  // One byte beyond the limit tells a file that is too large, even if it grows while it is read.
  std::string text(kMaxSceneBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxSceneBytes) {
    return Status{StatusCode::io, fmt::format("'{}' is larger than {} bytes: is it a scene?", path, kMaxSceneBytes)};
  }
  if (text.empty()) return Status{StatusCode::io, fmt::format("'{}' is empty: give a .textproto scene", path)};
  return text;
}

int runLoad(const Context& context, const std::string& path) {
  const Result<std::string> text = readScene(path);
  if (!text) return fail(kFile, text.status().message());
  int code = kDone;
  std::optional<Connection> connection = connect(context, commandsOnly(), code);
  if (!connection) return code;
  const client::Reply reply = connection->session.loadScene(*text).get();
  code = finish(context, reply, fmt::format("loaded {}", path));
  // A reply has room for the first problems only.
  if (reply.code == client::ReplyCode::scene)
    fmt::print(stderr, "'bleedd --scene {} --check' lists all that is wrong in a scene.\n", path);
  return code;
}

int runShutdown(const Context& context) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, commandsOnly(), code);
  if (!connection) return code;
  client::Session& session = connection->session;
  std::future<client::Reply> reply = session.shutdown();
  // A daemon that obeys at once may be gone before it has discovered who reads its reply: then nobody will send it again.
  while (reply.wait_for(kLook) != std::future_status::ready) {
    if (session.alive()) continue;
    client::Reply obeyed{.code = client::ReplyCode::accepted};
    if (const auto last = session.status()) {
      obeyed.applied_step = last->step;
      obeyed.sim_time_s = last->sim_time_s;
      obeyed.epoch = last->epoch;
    }
    return finish(context, obeyed, "shut down");
  }
  const int answered = finish(context, reply.get(), "shut down");
  if (answered != kDone) return answered;
  if (session.waitGone(context.timeout())) return kDone;
  return fail(kNoSession, fmt::format("session '{}' accepted, but still runs", session.name()));
}

}  // namespace

void addControlCommands(CLI::App& app, Context& context) {
  addPlain(app, context, "pause", "Stop the simulated clock", "paused", &Session::pause);
  addPlain(app, context, "resume", "Let the simulated clock run again", "resumed", &Session::resume);
  addPlain(app, context, "reset", "Start the scene again from its beginning", "reset", &Session::reset);

  CLI::App* step = app.add_subcommand("step", "Make N solver steps; the session has to be paused");
  const auto count = std::make_shared<std::uint32_t>(1);
  step->add_option("N", *count, "Number of steps")->required()->check(CLI::Range(1U, kMaxStepCount))->type_name("");
  step->callback([&context, count] {
    context.action = [&context, count] {
      int code = kDone;
      std::optional<Connection> connection = connect(context, commandsOnly(), code);
      return connection ? finish(context, connection->session.step(*count), fmt::format("{} steps begun", *count)) : code;
    };
  });

  CLI::App* pace = app.add_subcommand("pace", "Simulated against wall time: realtime, max, or a factor such as 0.5");
  const auto mode = std::make_shared<std::string>();
  pace->add_option("PACE", *mode, "realtime, max or simulated seconds per second")
      ->required()
      ->type_name("")
      ->check([](const std::string& text) {
        const Result<client::Pace> parsed = parsePace<client::Pace>(text);
        return parsed.ok() ? std::string{} : parsed.status().message();
      });
  pace->callback([&context, mode] {
    context.action = [&context, mode] {
      int code = kDone;
      const Result<client::Pace> parsed = parsePace<client::Pace>(*mode);
      if (!parsed) return fail(parsed.status());
      std::optional<Connection> connection = connect(context, commandsOnly(), code);
      return connection ? finish(context, connection->session.pace(*parsed), fmt::format("pace {}", *mode)) : code;
    };
  });

  CLI::App* load = app.add_subcommand("load", "Load another scene into the session");
  const auto path = std::make_shared<std::string>();
  load->add_option("FILE", *path, "Scene in protobuf text, as config/scenes/round_wound.textproto")->required()->type_name("");
  load->callback([&context, path] { context.action = [&context, path] { return runLoad(context, *path); }; });

  app.add_subcommand("shutdown", "End the session's daemon and wait until it is gone")->callback([&context] {
    context.action = [&context] { return runShutdown(context); };
  });
}

}  // namespace bleedsim::bleedctl
