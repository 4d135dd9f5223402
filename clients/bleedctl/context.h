// What the commands share: the global options, the sessions and how results are printed.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include "bleedsim/client.h"
#include "clients/bleedctl/exit_codes.h"

namespace bleedsim::bleedctl {

struct Context {
  client::ClientOptions connection;
  std::string session;  ///< empty: the first one found
  bool json = false;
  double timeout_s = 10.0;
  std::function<int()> action;  ///< of the command that was named; set while parsing, called after it

  std::chrono::nanoseconds timeout() const;
};

/// A client and a session of it, open for commands.
struct Connection {
  client::Client client;
  client::Session session;
};

/// Waits for the session for context.timeout(). On failure prints why to stderr and sets the exit code.
std::optional<Connection> connect(const Context& context, client::SessionOptions options, int& exit_code);

/// Prints "bleedctl: message" to stderr and returns the code that belongs to the status.
int fail(const Status& status);
int fail(ExitCode code, const std::string& message);

/// Waits for the reply and prints it: one line, or a JSON object. `done` says in words what was accepted.
int finish(const Context& context, std::future<client::Reply> reply, const std::string& done);
int finish(const Context& context, const client::Reply& reply, const std::string& done);

/// "X,Y,Z": three finite numbers; otherwise the message names the text.
Result<client::Vec3> parseVec3(const std::string& text);
/// A CLI11 check that refuses anything but three finite numbers.
std::string checkVec3(const std::string& text);

/// One function for each group of commands; each adds its commands to the program.
void addSessionCommands(CLI::App& app, Context& context);     // list, status, watch
void addControlCommands(CLI::App& app, Context& context);     // pause, resume, reset, step, pace, load, shutdown
void addCheckpointCommands(CLI::App& app, Context& context);  // checkpoint, restore, checkpoints
void addWoundCommands(CLI::App& app, Context& context);       // wound add, move, set, remove; force
void addEffectCommands(CLI::App& app, Context& context);      // effect list, on, off
void addRecordingCommands(CLI::App& app, Context& context);   // record, info, recover, export, render
void addLeaseCommand(CLI::App& app, Context& context);        // lease
void addDoctorCommand(CLI::App& app, Context& context);       // doctor

/// Parses, runs and returns the exit code.
int runBleedctl(int argc, const char* const* argv);

}  // namespace bleedsim::bleedctl
