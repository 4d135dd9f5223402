// A complete trainer loop: finds a session, opens a wound, pushes the blood with a tool and draws what comes back.
// usage: front_end [session [domain]]
#include <bleedsim/client.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

using namespace std::chrono_literals;
namespace client = bleedsim::client;

namespace {

int fail(const char* what, const std::string& why) {
  std::fprintf(stderr, "%s: %s\n", what, why.c_str());
  return 1;
}

/// Stands for the renderer: positions are x0 y0 z0 x1 ... in metres, ids name the same particle in every frame.
void draw(const client::Frame& frame, const std::optional<client::FrameStats>& stats) {
  float highest = 0.0F;
  for (std::size_t i = 2; i < frame.positions().size(); i += 3) highest = std::max(highest, frame.positions()[i]);
  std::printf("t = %.3f s: %u particles, highest %.1f mm, %.2f mL\n", frame.header().sim_time_s, frame.count(),
              static_cast<double>(highest) * 1e3, stats ? stats->emitted_ml : 0.0);
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

  auto wound = session->addWound({.name = "trainer", .position = {0.02, 0.0, 0.0}, .radius_m = 0.003, .flow_ml_per_s = 1.0});
  auto tool = session->instrument(1, "PSM1");
  if (!tool) return fail("no instrument", tool.status().message());
  if (auto round_trip = session->ping(2s)) std::printf("round trip %.2f ms\n", static_cast<double>(round_trip->count()) * 1e-6);

  for (int i = 0; i < 60; ++i) {
    const double angle = 0.1 * i;
    const auto sent = tool->send({.position = {0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.002},
                                  .tip_radius_m = 0.004,
                                  .force = {0.0, 0.0, -0.01}});
    if (!sent) return fail("instrument", sent.message());
    auto frame = session->waitFrame(5s);
    if (!frame) return fail("no frame", frame.status().message());
    draw(**frame, session->stats());
  }

  // A command is sent again until it is answered; its future never throws.
  const client::Reply opened = wound.get();
  if (!opened.accepted()) return fail("wound", opened.reason);
  const client::Reply closed = session->removeWound(opened.object_id).get();
  if (!closed.accepted()) return fail("wound", closed.reason);
  const client::FrameCounters counters = session->frameCounters();
  std::printf("done: %llu frames, %llu gaps\n", static_cast<unsigned long long>(counters.received),
              static_cast<unsigned long long>(counters.gaps));
  return 0;
}
