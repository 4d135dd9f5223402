// A complete trainer loop: finds a session, opens a wound, pushes the blood with a tool, draws what comes back, ends the session.
// usage: front_end [session [domain]]
#include <bleedsim/client.h>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace std::chrono_literals;
namespace client = bleedsim::client;

namespace {

int fail(const char* what, const std::string& why) {
  std::fprintf(stderr, "%s: %s\n", what, why.c_str());
  return 1;
}

/// Stands for the renderer: positions are x0 y0 z0 x1 ... in metres, ids name the same particle in every frame.
void draw(const client::Frame& frame) {
  float highest = 0.0F;
  for (std::size_t i = 2; i < frame.positions().size(); i += 3) highest = std::fmax(highest, frame.positions()[i]);
  std::printf("t = %.3f s: %u particles, highest %.1f mm\n", frame.header().sim_time_s, frame.count(), 1e3 * double{highest});
}

}  // namespace

int main(int argc, char** argv) {
  client::ClientOptions options;
  if (argc > 2) options.domain = static_cast<std::uint32_t>(std::atoi(argv[2]));
  auto here = client::Client::create(options);
  if (!here) return fail("no DDS", here.status().message());

  // An empty name takes the first session found. Newest wins: a slow renderer never slows the simulation.
  auto session = here->open(argc > 1 ? argv[1] : "", {.delivery = client::Delivery::newest}, 10s);
  if (!session) return fail("no session", session.status().message());
  if (auto round_trip = session->ping(2s)) std::printf("round trip %.2f ms\n", 1e-6 * static_cast<double>(round_trip->count()));

  // A command is sent again until it is answered; its future never throws.
  auto wound = session->addWound({.name = "trainer", .position = {0.02, 0.0, 0.0}, .radius_m = 0.003, .flow_ml_per_s = 1.0});
  const client::Reply opened = wound.get();
  if (!opened.accepted()) return fail("wound", opened.reason);
  auto tool = session->instrument(1, "PSM1");
  if (!tool) return fail("no instrument", tool.status().message());

  for (int i = 0; i < 60; ++i) {
    const double angle = 0.1 * i;
    const client::Vec3 tip{0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.002};
    const auto sent = tool->send({.position = tip, .tip_radius_m = 0.004, .force = {0.0, 0.0, -0.01}});
    if (!sent) return fail("instrument", sent.message());
    auto frame = session->waitFrame(5s);
    if (!frame) return fail("no frame", frame.status().message());
    draw(**frame);
  }

  if (const auto stats = session->stats()) {
    for (const client::WoundFlow& flow : stats->wounds) {
      if (flow.id == opened.object_id) std::printf("trainer's wound bled %.3f mL\n", flow.emitted_ml);
    }
    std::printf("real-time factor %.2f, %.3f mL in all\n", stats->real_time_factor, stats->emitted_ml);
  }
  const client::FrameCounters counters = session->frameCounters();
  std::printf("done: %u frames, %u gaps\n", unsigned(counters.received), unsigned(counters.gaps));

  const client::Reply ended = session->shutdown().get();
  if (!ended.accepted()) return fail("shutdown", ended.reason);
  return session->waitGone(10s) ? 0 : fail("shutdown", "the session still runs");
}
