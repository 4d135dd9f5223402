// Writes the seeds of the fuzz targets: good inputs of each kind, in the form that the target reads.
//   fuzz_seeds FOLDER
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "service/checkpoint/state_file.h"
#include "service/sph/state_bytes.h"
#include "service/sph/wound/wound_set.h"
#include "tests/unit/dds/samples.h"
#include "tests/unit/recording/random_samples.h"

namespace {

using namespace bleedsim;

class Bytes {
 public:
  /// The value's memory; never that of a std::string, which holds a pointer.
  template <class T>
  requires std::is_trivially_copyable_v<T> Bytes& add(const T& value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& add(std::string_view text) {
    text_ += text;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_{std::move(path)} {}
  void write(const std::string& target, const std::string& name, std::string_view bytes) const {
    std::filesystem::create_directories(path_ / target);
    std::ofstream{path_ / target / name, std::ios::binary}.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

Bytes wound(std::uint32_t shape, const std::vector<double>& outline) {
  bleed_v1_Wound sample = dds::discWound();
  sample.shape = shape;
  sample.radius2_m = 0.002;
  sample.width_m = 0.002;
  Bytes bytes;
  bytes.add(sample).add(static_cast<std::uint16_t>(outline.size()));
  for (const double number : outline) bytes.add(number);
  return bytes;
}

void writeRequests(const Folder& folder) {
  const auto write = [&](const std::string& name, std::uint8_t kind, const Bytes& body) {
    folder.write("request", name, Bytes{}.add(kind).add(body.text()).text());
  };
  const std::vector<double> square{-0.003, -0.003, 0.003, -0.003, 0.003, 0.003, -0.003, 0.003};
  write("wound_disc", bleed_v1_REQUEST_WOUND_ADD, wound(bleed_v1_SHAPE_DISC, {}));
  write("wound_ellipse", bleed_v1_REQUEST_WOUND_ADD, wound(bleed_v1_SHAPE_ELLIPSE, {}));
  write("wound_polygon", bleed_v1_REQUEST_WOUND_ADD, wound(bleed_v1_SHAPE_POLYGON, square));
  write("wound_polyline", bleed_v1_REQUEST_WOUND_ADD, wound(bleed_v1_SHAPE_POLYLINE, square));
  bleed_v1_WoundUpdate update{};
  update.wound_id = 1;
  update.fields = 31;
  write("wound_update", bleed_v1_REQUEST_WOUND_UPDATE, Bytes{}.add(update).add(wound(bleed_v1_SHAPE_POLYGON, square).text()));
  bleed_v1_WoundRemove removal{};
  dds::copyText("cut", removal.wound_name);
  write("wound_remove", bleed_v1_REQUEST_WOUND_REMOVE, Bytes{}.add(removal));
  write("force", bleed_v1_REQUEST_FORCE, Bytes{}.add(dds::push()));
  write("step", bleed_v1_REQUEST_STEP, Bytes{}.add(bleed_v1_StepCount{25}));
  write("pace", bleed_v1_REQUEST_PACE, Bytes{}.add(bleed_v1_Pace{bleed_v1_PACE_FACTOR, 0.5}));
  write("output", bleed_v1_REQUEST_OUTPUT, Bytes{}.add(bleed_v1_Output{30.0, true, 0x7F}));
  write("load_scene", bleed_v1_REQUEST_LOAD_SCENE, Bytes{}.add(std::string_view{"name: 'a'"}));
  bleed_v1_Effect effect{};
  dds::copyText("viscosity", effect.name);
  dds::copyText("viscosity_pa_s: 0.01", effect.settings);
  effect.enabled = true;
  write("effect", bleed_v1_REQUEST_EFFECT, Bytes{}.add(effect));
  write("acquire", bleed_v1_REQUEST_ACQUIRE, Bytes{}.add(bleed_v1_Lease{60.0}));
  bleed_v1_Checkpoint named{};
  dds::copyText("before_2", named.name);
  write("checkpoint", bleed_v1_REQUEST_CHECKPOINT, Bytes{}.add(named));
  write("unknown", 255, Bytes{}.add(std::uint32_t{9999}));
}

void writeFrames(const Folder& folder) {
  const auto write = [&](const std::string& name, std::uint32_t count, const std::vector<bleed_v1_Attribute>& attributes,
                         std::size_t bytes) {
    Bytes input;
    input.add(count).add(0.5).add(static_cast<std::uint8_t>(attributes.size()));
    for (const bleed_v1_Attribute& attribute : attributes) input.add(attribute);
    folder.write("frame", name, input.add(std::string(bytes, '\x3d')).text());
  };
  const bleed_v1_Attribute position{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F};
  const bleed_v1_Attribute small{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_UINT16, 3, 1e-5F, -0.1F};
  const bleed_v1_Attribute id{bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, 1.0F, 0.0F};
  const bleed_v1_Attribute velocity{bleed_v1_SEMANTIC_VELOCITY, bleed_v1_SCALAR_UINT16, 3, 1e-3F, 0.0F};
  const bleed_v1_Attribute density{bleed_v1_SEMANTIC_DENSITY, bleed_v1_SCALAR_FLOAT32, 1, 1.0F, 0.0F};
  const bleed_v1_Attribute later{77, bleed_v1_SCALAR_UINT16, 2, 1.0F, 0.0F};
  write("empty", 0, {position, id}, 0);
  write("least", 2, {position, id}, 2 * 16);
  write("all", 3, {small, id, velocity, density, later}, 3 * (6 + 4 + 6 + 4 + 4));
}

void writeRecordings(const Folder& folder) {
  const recording::test::ScratchFile file{"seed.mcap"};
  recording::test::writeRecording(file.path(), 3, 1500);
  const std::string bytes = recording::test::readAll(file.path());
  folder.write("recording", "whole", bytes);
  folder.write("recording", "cut", std::string_view{bytes}.substr(0, bytes.size() / 2));
  std::mt19937_64 random{5};
  for (int kind = 0; kind < recording::test::kJournalKinds; ++kind) {
    const std::string journal = recording::test::makeJournal(random, 1, kind).SerializeAsString();
    folder.write("message", "journal_" + std::to_string(kind), Bytes{}.add(std::uint8_t{4}).add(journal).text());
  }
  folder.write("message", "scene",
               Bytes{}.add(std::uint8_t{3}).add(recording::test::makeScene(random).SerializeAsString()).text());
  folder.write("message", "frame",
               Bytes{}.add(std::uint8_t{0}).add(recording::test::makeFrame(random, 1, 3).SerializeAsString()).text());
  folder.write("message", "stats",
               Bytes{}.add(std::uint8_t{1}).add(recording::test::makeStats(1, 0.5).SerializeAsString()).text());
  recording::Status status;
  recording::test::randomize(random, status);
  folder.write("message", "status", Bytes{}.add(std::uint8_t{2}).add(status.SerializeAsString()).text());
}

/// A list as the target reads it: how many, then each.
template <class Element>
Bytes& addList(Bytes& bytes, const std::vector<Element>& list) {
  bytes.add(static_cast<std::uint16_t>(list.size()));
  for (const Element& element : list) bytes.add(element);
  return bytes;
}
Bytes& addText(Bytes& bytes, std::string_view text) { return bytes.add(static_cast<std::uint16_t>(text.size())).add(text); }

void writeSamples(const Folder& folder) {
  const auto write = [&](const std::string& name, std::uint8_t kind, const Bytes& sample) {
    folder.write("sample", name, Bytes{}.add(kind).add(sample.text()).text());
  };
  using Name = std::array<char, 65>;
  bleed_v1_Counter counter{"requests", 3};
  Bytes frame;
  addList<bleed_v1_Attribute>(frame.add(bleed_v1_Frame{}),
                              {{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F}});
  write("frame", 0, addList<std::uint8_t>(frame, std::vector<std::uint8_t>(12)));
  Bytes stats;
  addList<bleed_v1_StageCost>(stats.add(bleed_v1_FrameStats{}), {{"force", 120.0}});
  addList<bleed_v1_WoundLedger>(stats, {{1, 0.5, 1.5}});
  addList<bleed_v1_Counter>(stats, {counter});
  write("stats", 1, addList<bleed_v1_InstrumentApplied>(stats, {{{}, 7, 1000, 20}}));
  bleed_v1_Status running{};
  running.state = bleed_v1_STATE_RUNNING;
  dds::copyText("theatre", running.session_name);
  Bytes status;
  addList<bleed_v1_Counter>(status.add(running), {counter});
  addList<bleed_v1_ClientActivity>(status, {{{}, 9, 1, 0, 0, 100, 0, 0.1}});
  write("status", 2, addList<bleed_v1_CheckpointInfo>(status, {{"auto-1", 1, 200, 0.5, 30'000, 1'000, 1}}));
  Bytes scene;
  addList<Name>(scene.add(bleed_v1_Scene{}), {Name{"gravity"}});
  addList<Name>(scene, {Name{"gravity"}, Name{"wetting"}});
  write("scene", 3, addText(addText(scene, "name: 'a'"), "name: 'b'"));
  write("reply", 4, Bytes{}.add(bleed_v1_Reply{}));
  const auto journal = [&](const std::string& name, std::uint8_t kind, const Bytes& body) {
    const Bytes head =
        Bytes{}.add(std::string(16, 'u')).add(std::uint32_t{1}).add(std::uint64_t{1}).add(std::uint64_t{0}).add(0.0);
    write("journal_" + name, 5, Bytes{}.add(head.text()).add(kind).add(body.text()));
  };
  const std::string request(4 + 16 + 8 + 8, '\1');  // object_id, client, run, seq
  journal("wound", bleed_v1_JOURNAL_REQUEST,
          Bytes{}.add(request).add(std::uint8_t{bleed_v1_REQUEST_WOUND_ADD}).add(wound(bleed_v1_SHAPE_DISC, {}).text()));
  bleed_v1_Effect effect{};
  dds::copyText("viscosity", effect.name);
  effect.enabled = true;
  journal("effect", bleed_v1_JOURNAL_REQUEST, Bytes{}.add(request).add(std::uint8_t{bleed_v1_REQUEST_EFFECT}).add(effect));
  journal("instrument", bleed_v1_JOURNAL_INSTRUMENT, Bytes{}.add(dds::instrumentSample()));
  journal("restored", bleed_v1_JOURNAL_RESTORED, Bytes{}.add(bleed_v1_Restored{{}, 1, 200, 3, 77, "auto-1"}));
  journal("switched", bleed_v1_JOURNAL_SWITCHED, Bytes{}.add(bleed_v1_Switched{0.003, 1}));
  journal("decision", bleed_v1_JOURNAL_DECISION, Bytes{}.add(std::string_view{"wetting: off"}));
}

void writeCheckpoints(const Folder& folder) {
  checkpoint::Head head;
  head.name = "seed";
  head.build_id = "1.0.0";
  head.simd_target = "avx2";
  head.precision = "float32";
  head.scene_text = head.loaded_text = "name: 'seed'";
  head.former_settings = {{"viscosity", "viscosity_pa_s: 0.01"}};
  head.mark.speed_of_sound = 5.0;
  head.mark.tools[0].tool = 2;
  head.mark.tool_count = 1;
  const std::array<std::byte, 5> state{};
  const std::string file = checkpoint::encodeCheckpoint(head, state);
  folder.write("checkpoint", "whole", Bytes{}.add(std::uint8_t{0}).add(std::string_view{file}).text());
  folder.write("checkpoint", "head",
               Bytes{}.add(std::uint8_t{1}).add(std::string_view{file}.substr(40, file.size() - 45)).text());

  sph::WorldDescription description;
  description.spacing = 0.002;
  description.max_wounds = 4;
  sph::WoundSet wounds{description, 5.0};
  sph::WoundDescription wound;
  wound.name = "cut";
  wound.shape = sph::PolygonPatch{{{-0.003, -0.003}, {0.003, -0.003}, {0.0, 0.004}}};
  wound.drive = sph::PressureDriveSettings{50.0, 0.6};
  static_cast<void>(wounds.add(wound));
  wound.name = "other";
  wound.position.x() = 0.02;
  wound.shape = sph::PolylinePatch{{{-0.003, 0.0}, {0.003, 0.0}}, 0.002};
  wound.drive = sph::FlowDrive{1e-6};
  static_cast<void>(wounds.add(wound));
  for (int k = 0; k < 50; ++k) wounds.advance(1e-4, [k](const sph::InletSpawn&) { return k % 3 != 0; });
  std::array<std::byte, 65536> room{};
  sph::StateWriter out{room};
  wounds.save(out);
  folder.write("checkpoint", "wounds",
               Bytes{}.add(std::uint8_t{2}).add(std::string_view{reinterpret_cast<const char*>(room.data()), out.used()}).text());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const Folder folder{argv[1]};
  writeRequests(folder);
  writeFrames(folder);
  writeRecordings(folder);
  writeSamples(folder);
  writeCheckpoints(folder);
  folder.write("instrument", "good", Bytes{}.add(dds::instrumentSample()).text());
  folder.write("effect", "viscosity",
               Bytes{}.add(std::uint8_t{2}).add(std::string_view{"viscosity_pa_s: 0.01 solve: EXPLICIT"}).text());
  folder.write("effect", "off", Bytes{}.add(std::uint8_t{224}).text());
  folder.write("effect", "tension", Bytes{}.add(std::uint8_t{3}).add(std::string_view{"sigma_n_per_m: 0.06"}).text());
  folder.write("scene", "least",
               "domain { lower_m {} upper_m { x: 0.1 y: 0.1 z: 0.1 } capacity: 10 }\nresolution { spacing_m: 0.002 }\n"
               "compressibility { design_speed_m_per_s: 0.3 }\n");
  return 0;
}
