// wound add, move, set and remove; force.
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "clients/bleedctl/context.h"
#include "service/status/number_text.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::bleedctl {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;

auto inRange(const Range& range, double unit = 1.0) { return finiteIn(range.lower / unit, range.upper / unit); }

/// What the options of these commands hold, as they were written.
struct Values {
  std::string at;
  std::string normal;
  std::string newtons;
  std::string name;
  double radius_mm = 0.0;
  double flow_ml_per_s = 0.0;
  double pressure_mmhg = 0.0;
  double duration_s = 0.1;
  std::string wound;
};

std::string checkPosition(const std::string& text) {
  const Result<client::Vec3> position = parseVec3(text);
  if (!position) return position.status().message();
  for (const double coordinate : *position) {
    if (coordinate < kCoordinate.lower || coordinate > kCoordinate.upper) {
      return fmt::format("'{}' is too far away: use coordinates from {:g} to {:g} m", text, kCoordinate.lower, kCoordinate.upper);
    }
  }
  return {};
}

std::string checkNewtons(const std::string& text) {
  const Result<client::Vec3> newtons = parseVec3(text);
  if (!newtons) return newtons.status().message();
  const double length = std::hypot((*newtons)[0], (*newtons)[1], (*newtons)[2]);
  if (length <= kForce.upper) return {};
  return fmt::format("'{}' is a force of {:g} N: use at most {:g} N", text, length, kForce.upper);
}

std::optional<std::uint32_t> parseId(const std::string& text) {
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole ? std::optional{id} : std::nullopt;
}

/// An id of digits alone, or else a name.
CLI::Option* addWoundOption(CLI::App& command, Values& values) {
  return command.add_option("ID", values.wound, "ID or name of the wound")
      ->required()
      ->check([](const std::string& text) { return text.empty() ? "an empty ID: give the ID or the name of a wound" : ""; })
      ->type_name("");
}

/// Calls act(id) or act(name).
template <class Act>
auto onWound(const std::string& wound, Act&& act) {
  const std::optional<std::uint32_t> id = parseId(wound);
  return id ? act(*id) : act(wound);
}

client::Vec3 vec3(const std::string& checked) { return parseVec3(checked).value(); }

/// Runs `send` on the session.
template <class Send>
std::function<int()> command(const Context& context, const std::string& done, Send send) {
  return [&context, done, send] {
    int code = kDone;
    std::optional<Connection> connection = connect(context, {.delivery = client::Delivery::none}, code);
    return connection ? finish(context, send(connection->session), done) : code;
  };
}

void addAdd(CLI::App& wound, Context& context) {
  CLI::App* add = wound.add_subcommand("add", "Open a round wound; prints its ID");
  const auto v = std::make_shared<Values>();
  add->add_option("--at", v->at, "Centre in m")->required()->check(checkPosition)->type_name("X,Y,Z");
  add->add_option("--radius-mm", v->radius_mm, "Radius in mm")
      ->required()
      ->check(inRange(kPatchLength, kMetresPerMillimetre))
      ->type_name("R");
  CLI::Option* flow = add->add_option("--flow-ml-per-s", v->flow_ml_per_s, "Flow in mL/s")->check(inRange(kFlow))->type_name("Q");
  CLI::Option* pressure = add->add_option("--pressure-mmhg", v->pressure_mmhg, "Inlet pressure in mmHg instead of a flow")
                              ->check(inRange(kInletPressure))
                              ->type_name("P");
  flow->excludes(pressure);
  add->add_option("--normal", v->normal, "Outward direction, of any length; default 0,0,1")->check(checkVec3)->type_name("X,Y,Z");
  add->add_option("--name", v->name, "Name of the wound")->type_name("NAME");
  add->callback([&context, v, flow, pressure] {
    if (flow->count() + pressure->count() == 0) throw CLI::RequiredError("--flow-ml-per-s (or --pressure-mmhg)");
    client::WoundSpec spec{.name = v->name, .position = vec3(v->at), .radius_m = v->radius_mm * kMetresPerMillimetre};
    spec.flow_ml_per_s = v->flow_ml_per_s;
    if (!v->normal.empty()) spec.normal = vec3(v->normal);
    if (pressure->count() > 0) spec.pressure_mmhg = v->pressure_mmhg;
    context.action = command(context, "wound opened", [spec](client::Session& s) { return s.addWound(spec); });
  });
}

void addMove(CLI::App& wound, Context& context) {
  CLI::App* move = wound.add_subcommand("move", "Move a wound");
  const auto v = std::make_shared<Values>();
  addWoundOption(*move, *v);
  move->add_option("--at", v->at, "New centre in m")->required()->check(checkPosition)->type_name("X,Y,Z");
  move->add_option("--normal", v->normal, "New outward direction")->check(checkVec3)->type_name("X,Y,Z");
  move->callback([&context, v] {
    client::WoundChange change{.position = vec3(v->at)};
    if (!v->normal.empty()) change.normal = vec3(v->normal);
    context.action = command(context, "wound moved", [wound = v->wound, change](client::Session& s) {
      return onWound(wound, [&](const auto& which) { return s.updateWound(which, change); });
    });
  });
}

void addSet(CLI::App& wound, Context& context) {
  CLI::App* set = wound.add_subcommand("set", "Change a wound's flow, pressure, radius, direction or name");
  const auto v = std::make_shared<Values>();
  addWoundOption(*set, *v);
  CLI::Option* flow = set->add_option("--flow-ml-per-s", v->flow_ml_per_s, "Flow in mL/s")->check(inRange(kFlow))->type_name("Q");
  CLI::Option* pressure = set->add_option("--pressure-mmhg", v->pressure_mmhg, "Inlet pressure in mmHg")
                              ->check(inRange(kInletPressure))
                              ->type_name("P");
  flow->excludes(pressure);
  CLI::Option* radius = set->add_option("--radius-mm", v->radius_mm, "Radius in mm: the wound becomes round")
                            ->check(inRange(kPatchLength, kMetresPerMillimetre))
                            ->type_name("R");
  CLI::Option* at = set->add_option("--at", v->at, "Centre in m")->check(checkPosition)->type_name("X,Y,Z");
  CLI::Option* normal = set->add_option("--normal", v->normal, "Outward direction")->check(checkVec3)->type_name("X,Y,Z");
  CLI::Option* name = set->add_option("--name", v->name, "Name of the wound")->type_name("NAME");
  set->callback([&context, v, flow, pressure, radius, at, normal, name] {
    client::WoundChange change;
    if (flow->count() > 0) change.flow_ml_per_s = v->flow_ml_per_s;
    if (pressure->count() > 0) change.pressure_mmhg = v->pressure_mmhg;
    if (radius->count() > 0) change.radius_m = v->radius_mm * kMetresPerMillimetre;
    if (at->count() > 0) change.position = vec3(v->at);
    if (normal->count() > 0) change.normal = vec3(v->normal);
    if (name->count() > 0) change.name = v->name;
    if (flow->count() + pressure->count() + radius->count() + at->count() + normal->count() + name->count() == 0) {
      throw CLI::RequiredError("one of --flow-ml-per-s, --pressure-mmhg, --radius-mm, --at, --normal, --name");
    }
    context.action = command(context, "wound changed", [wound = v->wound, change](client::Session& s) {
      return onWound(wound, [&](const auto& which) { return s.updateWound(which, change); });
    });
  });
}

void addRemove(CLI::App& wound, Context& context) {
  CLI::App* remove = wound.add_subcommand("remove", "Close a wound; its blood stays");
  const auto v = std::make_shared<Values>();
  addWoundOption(*remove, *v);
  remove->callback([&context, v] {
    context.action = command(context, "wound removed", [wound = v->wound](client::Session& s) {
      return onWound(wound, [&](const auto& which) { return s.removeWound(which); });
    });
  });
}

void addForce(CLI::App& app, Context& context) {
  CLI::App* force = app.add_subcommand("force", "Push the blood within a radius with a total force");
  const auto v = std::make_shared<Values>();
  force->add_option("--at", v->at, "Centre in m")->required()->check(checkPosition)->type_name("X,Y,Z");
  force->add_option("--radius-mm", v->radius_mm, "Reach in mm")
      ->required()
      ->check(inRange(kForceRadius, kMetresPerMillimetre))
      ->type_name("R");
  force->add_option("--newtons", v->newtons, "Force in N")->required()->check(checkNewtons)->type_name("X,Y,Z");
  force->add_option("--duration", v->duration_s, "Simulated seconds")
      ->check(inRange(kForceDuration))
      ->type_name("S")
      ->capture_default_str();
  force->callback([&context, v] {
    const client::ForceSpec spec{.position = vec3(v->at),
                                 .radius_m = v->radius_mm * kMetresPerMillimetre,
                                 .newtons = vec3(v->newtons),
                                 .duration_s = v->duration_s};
    context.action = command(context, "force applied", [spec](client::Session& s) { return s.force(spec); });
  });
}

}  // namespace

void addWoundCommands(CLI::App& app, Context& context) {
  CLI::App* wound = app.add_subcommand("wound", "Open, move, change or close wounds");
  wound->require_subcommand(1);
  addAdd(*wound, context);
  addMove(*wound, context);
  addSet(*wound, context);
  addRemove(*wound, context);
  addForce(app, context);
}

}  // namespace bleedsim::bleedctl
