#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "service/dds/command_limits.h"
#include "service/dds/decode.h"
#include "service/sph/world.h"
#include "tests/unit/dds/samples.h"

namespace bleedsim::dds {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bleed_v1_RequestBody bodyOf(std::uint32_t kind) {
  bleed_v1_RequestBody body{};
  body._d = kind;
  return body;
}

struct BadRequest {
  const char* name;
  std::function<bleed_v1_RequestBody()> make;
  StatusCode code;
  const char* text;
};

bleed_v1_RequestBody force(const std::function<void(bleed_v1_Force&)>& spoil) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_FORCE);
  body._u.force = push();
  spoil(body._u.force);
  return body;
}
bleed_v1_RequestBody pace(std::uint32_t mode, double factor) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_PACE);
  body._u.pace = {mode, factor};
  return body;
}
bleed_v1_RequestBody output(double rate, std::uint32_t attributes) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_OUTPUT);
  body._u.output = {rate, true, attributes};
  return body;
}
bleed_v1_RequestBody effect(const std::string& name, bool enabled, const std::string& settings) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_EFFECT);
  std::memcpy(body._u.effect.name, name.data(), name.size());
  std::memcpy(body._u.effect.settings, settings.data(), settings.size());
  body._u.effect.enabled = enabled;
  return body;
}
/// Both requests have the same body.
bleed_v1_RequestBody checkpoint(std::uint32_t kind, const std::string& name) {
  bleed_v1_RequestBody body = bodyOf(kind);
  std::memcpy(body._u.save_checkpoint.name, name.data(), name.size());
  return body;
}

bleed_v1_RequestBody acquire(double seconds) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_ACQUIRE);
  body._u.acquire.seconds = seconds;
  return body;
}
bleed_v1_RequestBody removal(std::uint32_t id, const std::string& name) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_WOUND_REMOVE);
  body._u.wound_remove.wound_id = id;
  std::memcpy(body._u.wound_remove.wound_name, name.data(), name.size());
  return body;
}
bleed_v1_RequestBody steps(std::uint32_t count) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_STEP);
  body._u.step.count = count;
  return body;
}
bleed_v1_RequestBody sceneText(char* text) {
  bleed_v1_RequestBody body = bodyOf(bleed_v1_REQUEST_LOAD_SCENE);
  body._u.load_scene.text = text;
  return body;
}

class BadRequestTest : public testing::TestWithParam<BadRequest> {};

TEST_P(BadRequestTest, IsRefusedWithTheReason) {
  const auto action = decodeAction(GetParam().make());
  ASSERT_FALSE(action.ok());
  EXPECT_EQ(action.status().code(), GetParam().code);
  EXPECT_THAT(action.status().message(), HasSubstr(GetParam().text));
  EXPECT_THAT(action.status().message(), testing::ContainsRegex("[:;] (use|send|name) ")) << "says what to do";
}

char empty_text[] = "";

INSTANTIATE_TEST_SUITE_P(
    All, BadRequestTest,
    testing::Values(
        BadRequest{"unknown_case", [] { return bodyOf(999); }, StatusCode::unsupported, "request 999"},
        BadRequest{"case_zero", [] { return bodyOf(0); }, StatusCode::unsupported, "request 0"},
        BadRequest{"force_nan", [] { return force([](auto& f) { f.newtons.x = kNaN; }); }, StatusCode::invalid_argument,
                   "force.newtons.x is nan"},
        BadRequest{"force_huge", [] { return force([](auto& f) { f.newtons.z = -1e7; }); }, StatusCode::invalid_argument,
                   "force.newtons.z is -1e+07"},
        BadRequest{"force_long", [] { return force([](auto& f) {
                                        f.newtons = {8e5, 8e5, 0.0};
                                      }); }, StatusCode::invalid_argument,
                   "force.newtons is 1.13137e+06: use 0 to 1e+06 N, its length"},
        BadRequest{"force_far", [] { return force([](auto& f) { f.position.y = -10.5; }); }, StatusCode::invalid_argument,
                   "force.position.y is -10.5: use -10 to 10 m"},
        BadRequest{"force_wide", [] { return force([](auto& f) { f.radius_m = 10.5; }); }, StatusCode::invalid_argument,
                   "force.radius_m is 10.5: use 1e-05 to 10 m"},
        BadRequest{"force_position", [] { return force([](auto& f) { f.position.y = kInfinity; }); },
                   StatusCode::invalid_argument, "force.position.y is inf"},
        BadRequest{"force_radius", [] { return force([](auto& f) { f.radius_m = 0.0; }); }, StatusCode::invalid_argument,
                   "force.radius_m"},
        BadRequest{"force_duration", [] { return force([](auto& f) { f.duration_s = -1.0; }); }, StatusCode::invalid_argument,
                   "force.duration_s"},
        BadRequest{"force_endless", [] { return force([](auto& f) { f.duration_s = kInfinity; }); }, StatusCode::invalid_argument,
                   "force.duration_s"},
        BadRequest{"pace_mode", [] { return pace(3, 1.0); }, StatusCode::invalid_argument, "pace.mode is 3"},
        BadRequest{"pace_zero", [] { return pace(bleed_v1_PACE_FACTOR, 0.0); }, StatusCode::invalid_argument, "pace.factor"},
        BadRequest{"pace_nan", [] { return pace(bleed_v1_PACE_FACTOR, kNaN); }, StatusCode::invalid_argument, "pace.factor"},
        BadRequest{"rate_negative", [] { return output(-60.0, 0); }, StatusCode::invalid_argument, "output.rate_hz"},
        BadRequest{"rate_slow", [] { return output(0.5, 0); }, StatusCode::invalid_argument, "use 1 to 1000 frames"},
        BadRequest{"rate_fast", [] { return output(1001.0, 0); }, StatusCode::invalid_argument, "use 1 to 1000 frames"},
        BadRequest{"rate_nan", [] { return output(kNaN, 0); }, StatusCode::invalid_argument, "output.rate_hz"},
        BadRequest{"attribute_later", [] { return output(0.0, 1U << 7U); }, StatusCode::unsupported, "output.attributes"},
        BadRequest{"effect_nameless", [] { return effect("", true, ""); }, StatusCode::invalid_argument, "effect.name is empty"},
        BadRequest{"effect_control", [] { return effect("a\x01", true, ""); }, StatusCode::invalid_argument,
                   "effect.name: byte 1 (0x01) is a control character"},
        BadRequest{"attribute_unknown", [] { return output(0.0, 1U << 31U); }, StatusCode::unsupported, "output.attributes"},
        BadRequest{"no_steps", [] { return steps(0); }, StatusCode::invalid_argument, "step.count is 0"},
        BadRequest{"too_many_steps", [] { return steps(0xFFFFFFFFU); }, StatusCode::invalid_argument, "step.count"},
        BadRequest{"lease_short", [] { return acquire(0.5); }, StatusCode::invalid_argument, "acquire.seconds is 0.5"},
        BadRequest{"lease_long", [] { return acquire(301.0); }, StatusCode::invalid_argument, "1 to 300 s of wall time"},
        BadRequest{"checkpoint_path", [] { return checkpoint(bleed_v1_REQUEST_CHECKPOINT, "../a"); },
                   StatusCode::invalid_argument, "checkpoint '../a': use 1 to 48 letters"},
        BadRequest{"checkpoint_slash", [] { return checkpoint(bleed_v1_REQUEST_RESTORE, "a/b"); }, StatusCode::invalid_argument,
                   "checkpoint 'a/b'"},
        BadRequest{"checkpoint_dot", [] { return checkpoint(bleed_v1_REQUEST_RESTORE, "."); }, StatusCode::invalid_argument,
                   "checkpoint '.'"},
        BadRequest{"checkpoint_control", [] { return checkpoint(bleed_v1_REQUEST_RESTORE, "a\x01z"); },
                   StatusCode::invalid_argument, "checkpoint 'a?z'"},
        BadRequest{"checkpoint_unterminated", [] { return checkpoint(bleed_v1_REQUEST_RESTORE, std::string(49, 'a')); },
                   StatusCode::invalid_argument, "use 1 to 48 letters"},
        BadRequest{"checkpoint_of_the_service", [] { return checkpoint(bleed_v1_REQUEST_CHECKPOINT, "auto-1"); },
                   StatusCode::invalid_argument, "the service's own"},
        BadRequest{"lease_nan", [] { return acquire(kNaN); }, StatusCode::invalid_argument, "acquire.seconds is nan"},
        BadRequest{"scene_null", [] { return sceneText(nullptr); }, StatusCode::invalid_argument, "load_scene.text is empty"},
        BadRequest{"scene_empty", [] { return sceneText(empty_text); }, StatusCode::invalid_argument,
                   "load_scene.text is empty"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

TEST(DecodeAction, RefusesAnEndlessScene) {
  std::string text(kMaxSceneBytes + 1, ' ');
  EXPECT_FALSE(decodeAction(sceneText(text.data())).ok());
  text.resize(kMaxSceneBytes);
  EXPECT_TRUE(decodeAction(sceneText(text.data())).ok());
}

TEST(DecodeAction, KnowsEveryRequest) {
  for (const std::uint32_t kind :
       {bleed_v1_REQUEST_PING, bleed_v1_REQUEST_PAUSE, bleed_v1_REQUEST_RESUME, bleed_v1_REQUEST_RESET,
        bleed_v1_REQUEST_WOUND_REMOVE, bleed_v1_REQUEST_OUTPUT, bleed_v1_REQUEST_PACE, bleed_v1_REQUEST_SHUTDOWN}) {
    EXPECT_TRUE(decodeAction(bodyOf(kind)).ok()) << kind;
  }
  EXPECT_TRUE(decodeAction(force([](auto&) {})).ok());
  EXPECT_TRUE(decodeAction(steps(3)).ok());
}

TEST(DecodeAction, TranslatesOutputAttributes) {
  const auto action = decodeAction(output(30.0, 1U << bleed_v1_SEMANTIC_VELOCITY | 1U << bleed_v1_SEMANTIC_DENSITY | 1U));
  ASSERT_TRUE(action.ok()) << action.status().message();
  const auto& set = std::get<SetOutput>(*action);
  EXPECT_EQ(set.frame_rate, 30.0);
  EXPECT_EQ(set.attributes, sph::kFrameVelocity | sph::kFrameDensity);
}

TEST(DecodeAction, TranslatesEveryAttribute) {
  const auto action = decodeAction(output(0.0, 0x7FU));
  ASSERT_TRUE(action.ok()) << action.status().message();
  EXPECT_EQ(std::get<SetOutput>(*action).attributes,
            sph::kFrameVelocity | sph::kFrameDensity | sph::kFrameViscosity | sph::kFramePlatelet | sph::kFrameRadius);
}

TEST(DecodeAction, ReadsAnEffect) {
  const auto action = decodeAction(effect("surface_tension", true, "sigma_n_per_m: 0.06"));
  ASSERT_TRUE(action.ok()) << action.status().message();
  const auto& set = std::get<SetEffect>(*action);
  EXPECT_EQ(set.name, "surface_tension");
  EXPECT_TRUE(set.enabled);
  EXPECT_EQ(set.settings, "sigma_n_per_m: 0.06");
}

TEST(DecodeAction, ReadsAnEffectWhoseTextsAreNotTerminated) {
  bleed_v1_RequestBody body = effect(std::string(33, 'n'), false, std::string(2049, 's'));
  const std::uint8_t strange = 0x5A;
  std::memcpy(&body._u.effect.enabled, &strange, 1);
  const auto action = decodeAction(body);
  ASSERT_TRUE(action.ok()) << action.status().message();
  const auto& set = std::get<SetEffect>(*action);
  EXPECT_EQ(set.name.size(), 33U);
  EXPECT_EQ(set.settings.size(), 2049U);
  EXPECT_TRUE(set.enabled);
}

TEST(DecodeAction, ReadsABooleanOfAnyByte) {
  bleed_v1_RequestBody body = output(0.0, 1U << bleed_v1_SEMANTIC_VELOCITY);
  const std::uint8_t strange = 0x5A;
  std::memcpy(&body._u.output.set_attributes, &strange, 1);
  const auto action = decodeAction(body);
  ASSERT_TRUE(action.ok());
  EXPECT_EQ(std::get<SetOutput>(*action).attributes, static_cast<std::uint32_t>(sph::kFrameVelocity));
  EXPECT_FALSE(std::get<SetOutput>(*action).frame_rate.has_value());
}

TEST(DecodeWoundName, IsEitherIdOrName) {
  EXPECT_EQ(*decodeWoundName(removal(0, "liver")), "liver");
  EXPECT_EQ(*decodeWoundName(removal(3, "")), "");
  const auto both = decodeWoundName(removal(3, "liver"));
  EXPECT_EQ(both.status().code(), StatusCode::invalid_argument);
  EXPECT_THAT(both.status().message(), HasSubstr("by one of them"));
  EXPECT_EQ(decodeWoundName(removal(0, "li\nver")).status().code(), StatusCode::invalid_argument);
  bleed_v1_RequestBody update = bodyOf(bleed_v1_REQUEST_WOUND_UPDATE);
  copyText("spleen", update._u.wound_update.wound_name);
  EXPECT_EQ(*decodeWoundName(update), "spleen");
  EXPECT_EQ(*decodeWoundName(bodyOf(bleed_v1_REQUEST_PAUSE)), "");
}

TEST(RequestCopy, OwnsWhatItPointsTo) {
  std::vector<double> outline{0.0, 0.0, 0.01, 0.0, 0.0, 0.01};
  bleed_v1_Request request{};
  request.body = bodyOf(bleed_v1_REQUEST_WOUND_ADD);
  request.body._u.wound_add = discWound();
  request.body._u.wound_add.outline = {6, 6, outline.data(), false};
  const RequestCopy copy{request};
  outline.assign(6, -1.0);
  const dds_sequence_double& kept = copy.sample().body._u.wound_add.outline;
  ASSERT_EQ(kept._length, 6U);
  EXPECT_EQ(kept._buffer[2], 0.01);

  std::string text = "name: 'a'";
  request.body = sceneText(text.data());
  const RequestCopy scene{request};
  text.assign(text.size(), 'x');
  EXPECT_STREQ(scene.sample().body._u.load_scene.text, "") << "the scene topic has it";
}

TEST(DecodeInstrument, KeepsWhatTheSampleSays) {
  const auto sample = decodeInstrument(instrumentSample());
  ASSERT_TRUE(sample.ok()) << sample.status().message();
  EXPECT_EQ(sample->key.client[0], 7);
  EXPECT_EQ(sample->key.tool, 3U);
  EXPECT_EQ(sample->seq, 41U);
  EXPECT_EQ(sample->force, sph::Vec3(0.1, 0.0, 0.0));
  EXPECT_STREQ(sample->original.name, "PSM1");
}

struct BadInstrument {
  const char* name;
  std::function<void(bleed_v1_Instrument&)> spoil;
  const char* message;
};

class BadInstrumentTest : public testing::TestWithParam<BadInstrument> {};

TEST_P(BadInstrumentTest, IsRefusedWithTheReason) {
  bleed_v1_Instrument sample = instrumentSample();
  GetParam().spoil(sample);
  const auto decoded = decodeInstrument(sample);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.status().code(), StatusCode::invalid_argument);
  EXPECT_THAT(decoded.status().message(), HasSubstr(GetParam().message));
  EXPECT_THAT(decoded.status().message(), testing::ContainsRegex("[:;] use ")) << "says what to do";
}

INSTANTIATE_TEST_SUITE_P(
    All, BadInstrumentTest,
    testing::Values(
        BadInstrument{"position_nan", [](auto& s) { s.position.x = kNaN; }, "instrument.position.x is nan"},
        BadInstrument{"position_far", [](auto& s) { s.position.y = 2e6; }, "instrument.position.y is 2e+06: use -10 to 10 m"},
        BadInstrument{"position_infinite", [](auto& s) { s.position.z = -kInfinity; }, "instrument.position.z is -inf"},
        BadInstrument{"force_infinite", [](auto& s) { s.force.z = kInfinity; }, "instrument.force.z is inf"},
        BadInstrument{"force_huge", [](auto& s) { s.force.x = 2e6; }, "instrument.force.x is 2e+06: use -1e+06 to 1e+06 N"},
        BadInstrument{"force_long",
                      [](auto& s) {
                        s.force = {8e5, 8e5, 0.0};
                      },
                      "instrument.force is 1.13137e+06: use 0 to 1e+06 N"},
        BadInstrument{"radius_none", [](auto& s) { s.tip_radius_m = 0.0; }, "instrument.tip_radius_m is 0: use 1e-05 to 10 m"},
        BadInstrument{"radius_negative", [](auto& s) { s.tip_radius_m = -1.0; }, "instrument.tip_radius_m is -1"},
        BadInstrument{"radius_wide", [](auto& s) { s.tip_radius_m = 10.5; }, "instrument.tip_radius_m is 10.5"},
        BadInstrument{"radius_nan", [](auto& s) { s.tip_radius_m = kNaN; }, "instrument.tip_radius_m is nan"},
        BadInstrument{"orientation_nan", [](auto& s) { s.orientation.w = kNaN; }, "instrument.orientation is nan"},
        BadInstrument{"orientation_infinite", [](auto& s) { s.orientation.x = kInfinity; }, "instrument.orientation is inf"},
        BadInstrument{"name_control", [](auto& s) { s.name[0] = '\x01'; },
                      "instrument.name: byte 0 (0x01) is a control character"},
        BadInstrument{"name_bytes", [](auto& s) { s.name[1] = '\xff'; }, "instrument.name: byte 1 (0xff) is not UTF-8"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

TEST(DecodeAction, TakesNamesOfCheckpoints) {
  const auto saved = decodeAction(checkpoint(bleed_v1_REQUEST_CHECKPOINT, "before_2"));
  ASSERT_TRUE(saved.ok()) << saved.status().message();
  EXPECT_EQ(std::get<SaveCheckpoint>(*saved).name, "before_2");
  const auto restored = decodeAction(checkpoint(bleed_v1_REQUEST_RESTORE, "auto-00000001"));
  ASSERT_TRUE(restored.ok()) << restored.status().message();
  EXPECT_EQ(std::get<RestoreCheckpoint>(*restored).name, "auto-00000001");
  EXPECT_EQ(std::get<SaveCheckpoint>(*decodeAction(checkpoint(bleed_v1_REQUEST_CHECKPOINT, ""))).name, "");
  EXPECT_EQ(std::get<RestoreCheckpoint>(*decodeAction(checkpoint(bleed_v1_REQUEST_RESTORE, ""))).name, "");
}

}  // namespace
}  // namespace bleedsim::dds
