#include "clients/bleedctl/context.h"

#include <cstdio>
#include <fmt/core.h>

#include "clients/bleedctl/json.h"
#include "service/status/number_text.h"

namespace bleedsim::bleedctl {
ExitCode exitCodeOf(const Status& status) {
  switch (status.code()) {
    case StatusCode::ok:
      return kDone;
    case StatusCode::invalid_argument:
    case StatusCode::not_found:
    case StatusCode::unavailable:
      return kUsage;
    case StatusCode::timed_out:
      return kNoSession;
    default:
      return kFailed;
  }
}

std::chrono::nanoseconds Context::timeout() const { return std::chrono::nanoseconds{static_cast<std::int64_t>(timeout_s * 1e9)}; }

std::optional<Connection> connect(const Context& context, client::SessionOptions options, int& exit_code) {
  Result<client::Client> client = client::Client::create(context.connection);
  if (!client) {
    exit_code = fail(client.status());
    return std::nullopt;
  }
  options.command_timeout = std::chrono::duration_cast<std::chrono::milliseconds>(context.timeout());
  Result<client::Session> session = client->open(context.session, options, context.timeout());
  if (!session) {
    exit_code = fail(session.status());
    return std::nullopt;
  }
  return Connection{std::move(*client), std::move(*session)};
}

int fail(const Status& status) { return fail(exitCodeOf(status), status.message()); }

int fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "bleedctl: {}\n", message);
  return code;
}

int finish(const Context& context, std::future<client::Reply> reply, const std::string& done) {
  return finish(context, reply.get(), done);
}

int finish(const Context& context, const client::Reply& reply, const std::string& done) {
  if (context.json) {
    JsonObject json;
    json.add("code", client::toString(reply.code)).add("accepted", reply.accepted()).add("reason", reply.reason);
    json.add("applied_step", reply.applied_step).add("sim_time_s", reply.sim_time_s).add("epoch", reply.epoch);
    fmt::print("{}\n", json.add("object_id", reply.object_id).text());
  }
  if (reply.accepted()) {
    if (!context.json) {
      const std::string object = reply.object_id != 0 ? fmt::format(" [wound {}]", reply.object_id) : std::string{};
      fmt::print("{}{} at step {} ({:.4f} s)\n", done, object, reply.applied_step, reply.sim_time_s);
    }
    std::fflush(stdout);  // a command that goes on waiting may be ended by a signal
    return kDone;
  }
  const ExitCode code = reply.code == client::ReplyCode::no_answer  ? kNoSession
                        : reply.code == client::ReplyCode::not_sent ? kUsage
                                                                    : kFailed;
  return fail(code, fmt::format("{}: {}", client::toString(reply.code), reply.reason));
}

Result<client::Vec3> parseVec3(const std::string& text) {
  client::Vec3 out{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) break;
    const std::optional<double> value = parseNumber(rest.substr(0, comma));
    if (!value) break;
    out[i] = *value;
    if (i == 2) return out;
    rest.remove_prefix(comma + 1);
  }
  return Status{StatusCode::invalid_argument,
                fmt::format("'{}' is not X,Y,Z: write three finite numbers with commas and no spaces, as 0.01,0,0", text)};
}

std::string checkVec3(const std::string& text) {
  const Result<client::Vec3> parsed = parseVec3(text);
  return parsed.ok() ? std::string{} : parsed.status().message();
}

}  // namespace bleedsim::bleedctl
