// effect list, on and off.
#include <algorithm>
#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/effect_settings.h"
#include "clients/bleedctl/json.h"

namespace bleedsim::bleedctl {
namespace {

/// On, off, or off by the service's own decision: it stands in the scene's text but does not act.
const char* stateOf(bool acts, bool written) {
  if (acts) return "on";
  return written ? "auto-off" : "off";
}

int runList(const Context& context) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, {.delivery = client::Delivery::none}, code);
  if (!connection) return code;
  const Result<client::SceneInfo> scene = connection->session.waitScene(context.timeout());
  if (!scene) return fail(scene.status());
  const std::map<std::string, std::string> settings = effectSettings(scene->text);
  const std::vector<std::string>& known = scene->known_effects.empty() ? scene->effects : scene->known_effects;
  JsonArray array;
  for (const std::string& name : known) {
    const bool acts = std::find(scene->effects.begin(), scene->effects.end(), name) != scene->effects.end();
    const auto written = settings.find(name);
    const char* state = stateOf(acts, written != settings.end());
    const std::string text = written != settings.end() ? written->second : std::string{};
    if (context.json) {
      array.raw(JsonObject{}.add("name", name).add("state", state).add("on", acts).add("settings", text).text());
    } else {
      fmt::print("{:<9}{:<16}{}\n", state, name, text);
    }
  }
  if (context.json) fmt::print("{}\n", array.text());
  return kDone;
}

void addSwitch(CLI::App& effect, Context& context, bool enabled) {
  CLI::App* command = effect.add_subcommand(enabled ? "on" : "off",
                                            enabled ? "Switch an effect on, or give it other settings" : "Switch an effect off");
  const auto name = std::make_shared<std::string>();
  const auto settings = std::make_shared<std::vector<std::string>>();
  command->add_option("NAME", *name, "Name of the effect, see 'effect list'")->required()->type_name("");
  if (enabled) {
    command
        ->add_option("--set", *settings,
                     "Settings as in a scene, e.g. 'viscosity_pa_s: 0.01'; may be repeated. What is left out takes its default. "
                     "Without it: the settings the effect had when it was last on")
        ->type_name("'FIELD: VALUE ...'")
        ->take_all();
  }
  command->callback([&context, name, settings, enabled] {
    context.action = [&context, name, settings, enabled] {
      std::string text;
      for (const std::string& part : *settings) text += (text.empty() ? "" : " ") + part;
      int code = kDone;
      std::optional<Connection> connection = connect(context, {.delivery = client::Delivery::none}, code);
      if (!connection) return code;
      return finish(context, connection->session.setEffect(*name, enabled, text),
                    fmt::format("{} is {}", *name, enabled ? "on" : "off"));
    };
  });
}

}  // namespace

void addEffectCommands(CLI::App& app, Context& context) {
  CLI::App* effect = app.add_subcommand("effect", "List the effects of a session, switch them while it runs");
  effect->require_subcommand(1);
  effect->add_subcommand("list", "Show which effects act, with their settings")->callback([&context] {
    context.action = [&context] { return runList(context); };
  });
  addSwitch(*effect, context, true);
  addSwitch(*effect, context, false);
}

}  // namespace bleedsim::bleedctl
