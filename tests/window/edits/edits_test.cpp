// Random edits of random designs: the window shows of each version what a fresh process shows.
// SCADRAY_TEST_EDITS=N sets the number of edits, SCADRAY_TEST_SEED=S the first design.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <semaphore>
#include <stdexcept>

#include "edits/edited_design.hpp"
#include "follow/design_reading.hpp"
#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"
#include "painter.hpp"
#include "solids/solid_pool.hpp"
#include "support/full_run.hpp"
#include "temporary_folder.hpp"

namespace window {
namespace {

using frontend::DesignVersion;
using frontend::Technique;
using window_test::EditedDesign;
using Lines = std::vector<std::string>;

constexpr std::size_t kEditsPerDesign = 20;
/// A design of more takes longer, and tests no more.
constexpr std::size_t kMostNodes = 600, kMostPrimitives = 200;
constexpr Size kSize{48, 36};
/// Far longer than a picture takes, on a slow machine and under a sanitizer.
constexpr std::chrono::seconds kPatience{60};

/// A painter that is waited for.
class Canvas {
  template <typename Take>
  auto next(const Take& take) {
    while (true) {
      if (auto found = take()) return std::move(*found);
      if (!news_.try_acquire_for(kPatience)) throw std::runtime_error("no painting");
    }
  }

 public:
  Painting paint(PaintOrder order) {
    painter_.order(std::move(order));
    return next([this] { return painter_.take_painting(); });
  }
  Finding find(Probe probe) {
    painter_.probe(std::move(probe));
    return next([this] { return painter_.take_finding(); });
  }

 private:
  std::counting_semaphore<> news_{0};
  Painter painter_{1e6, [this] { news_.release(); }};  // declared last, since it calls back
};

/// As the window has it.
frontend::DesignFileOptions reading_options(uint32_t seed) {
  frontend::DesignFileOptions options;
  options.evaluator = frontend::Evaluator::kOwn;
  options.import.keeps_places = true;
  options.import.keeps_meshes = true;
  if (seed % 5 == 4) options.openscad_arguments = {"-D", "v3=4", "-D", "$l=2"};
  return options;
}

/// Reads a design again and again, as DesignFollower does, without waiting for saves.
class Follower {
 public:
  Follower(std::string path, frontend::DesignFileOptions options)
      : path_(std::move(path)), options_(std::move(options)) {
    options_.import.solids =
        std::make_shared<frontend::SolidPool>(frontend::SolidPool::Keeps::kAll);
    options_.cache = std::make_shared<language::EvaluationCache>();
  }
  DesignVersion read(const frontend::DesignInputs& inputs) {
    options_.inputs = inputs;
    good_.lacks_files = true;  // so that a broken used file ends nothing, as in a fresh process
    frontend::DesignReading reading = frontend::read_anew(path_, options_, good_, {});
    good_ = std::move(reading.good);
    return std::move(reading.version);
  }

 private:
  const std::string path_;
  frontend::DesignFileOptions options_;
  frontend::GoodVersion good_;
};

/// Reads a design as a process does that has not read it before.
DesignVersion read_fresh(const std::string& path, frontend::DesignFileOptions options,
                         const frontend::DesignInputs& inputs) {
  options.inputs = inputs;
  return frontend::read_anew(path, options, {}, {}).version;
}

/// Returns the nodes with their places.
Lines places_of(const language::Evaluation& evaluation) {
  const language::SourceFiles& files = *evaluation.files;
  Lines places;
  for (const language::Node& node : evaluation.tree->nodes) {
    std::string place =
        std::string(name_of(node.kind)) + (node.is_module_call ? " called at " : " at ");
    if (node.place.file != language::kNoFile && files.has(node.place.file)) {
      place += files[node.place.file].path + ":" + std::to_string(files.line(node.place)) + ":" +
               std::to_string(files.column(node.place));
    }
    places.push_back(std::move(place));
  }
  return places;
}

Lines parameters_of(const DesignVersion& version) {
  Lines lines;
  for (const auto& parameter : version.parameters->list) {
    lines.push_back(parameter.name + " = " + language::set_text(parameter.value));
  }
  return lines;
}

Lines texts_of(const std::vector<frontend::Warning>& warnings) {
  Lines lines;
  for (const frontend::Warning& warning : warnings) lines.push_back(warning.text);
  return lines;
}

void expect_same_design(const frontend::ImportedDesign& kept,
                        const frontend::ImportedDesign& fresh) {
  EXPECT_EQ(texts_of(kept.warnings), texts_of(fresh.warnings));
  EXPECT_EQ(kept.files, fresh.files);
  EXPECT_EQ(kept.primitive_nodes, fresh.primitive_nodes);
  EXPECT_EQ(kept.leaves, fresh.leaves);
  EXPECT_EQ(kept.left_out, fresh.left_out);
  EXPECT_EQ(kept.view_box.min, fresh.view_box.min);
  EXPECT_EQ(kept.view_box.max, fresh.view_box.max);
  EXPECT_EQ(kept.scene.primitives.size(), fresh.scene.primitives.size());
}

/// The numbers of files differ, so trees are compared as text.
void expect_same_version(const DesignVersion& kept, const DesignVersion& fresh) {
  EXPECT_EQ(kept.error, fresh.error);
  EXPECT_EQ(kept.messages, fresh.messages);
  EXPECT_EQ(kept.inputs, fresh.inputs);
  if (fresh.parameters) {
    EXPECT_EQ(kept.parameters->text, fresh.parameters->text);
    EXPECT_EQ(parameters_of(kept), parameters_of(fresh));
  }
  if (!kept.error.empty() || !fresh.error.empty()) return;
  EXPECT_EQ(kept.camera, fresh.camera);
  const language::Evaluation& kept_tree = *kept.source.evaluation;
  const language::Evaluation& fresh_tree = *fresh.source.evaluation;
  EXPECT_EQ(language::csg_text(*kept_tree.tree), language::csg_text(*fresh_tree.tree));
  EXPECT_EQ(places_of(kept_tree), places_of(fresh_tree));
  EXPECT_EQ(kept_tree.files_read, fresh_tree.files_read);
  EXPECT_EQ(kept_tree.lookups, fresh_tree.lookups);
  expect_same_design(*kept.design, *fresh.design);
}

/// Lines of a trail, each with its place.
Lines words_of(const Finding& finding) {
  Lines words;
  for (const frontend::TrailStep& step : finding.place.trail) {
    words.push_back(step.what + " " + text_of(step.place));
  }
  return words;
}

/// What is looked at, and how: changed by the user now and then.
class Look {
 public:
  explicit Look(uint32_t seed) {
    order_.navigation = {
        {}, seed % 2 == 0 ? csgcore::Projection::kPerspective : csgcore::Projection::kOrthographic};
    order_.size = kSize;
    order_.settings.renderer = frontend::RendererKind::kCpu;
    order_.settings.samples = seed % 3 == 2 ? 4 : 1;
    order_.settings.measured_channels = seed % 4 < 2;
    order_.overlays.edges = seed % 7 == 3;
    order_.overlays.axes = seed % 7 == 4;
  }

  void change(window_test::RandomStatements& random, const csgcore::Box& view_box) {
    if (!has_seen_all_ || random.chance(15)) {
      const frontend::CameraOptions all;
      order_.navigation =
          Navigation(frontend::choose_camera(all, view_box), order_.navigation.projection());
    }
    has_seen_all_ = true;
    if (random.chance(12)) order_.navigation.turn(20, 7, false);
    if (random.chance(10)) order_.section.is_on = !order_.section.is_on;
    if (random.chance(20)) order_.section.position += 1;
  }
  PaintOrder order(const DesignVersion& version, Technique technique) {
    PaintOrder order = order_;
    order.number = version.number;
    order.design = version.design;
    order.settings.technique = technique;
    return order;
  }

 private:
  PaintOrder order_;
  bool has_seen_all_ = false;
};

void expect_same_picture(Canvas& kept, const PaintOrder& kept_order, const PaintOrder& order) {
  Canvas fresh;
  const Painting seen = kept.paint(kept_order), anew = fresh.paint(order);
  EXPECT_TRUE(seen.is_final || !seen.error.empty());
  EXPECT_EQ(seen.error, anew.error);
  EXPECT_TRUE(seen.image.rgb == anew.image.rgb);
  EXPECT_TRUE(seen.image.z == anew.image.z);
  EXPECT_TRUE(seen.image.id == anew.image.id);
  EXPECT_TRUE(seen.image.normal == anew.image.normal);
}

void expect_same_finding(Canvas& kept, const Probe& kept_probe, const Probe& probe) {
  Canvas fresh;
  const Finding seen = kept.find(kept_probe), anew = fresh.find(probe);
  EXPECT_EQ(seen.is_hit, anew.is_hit);
  EXPECT_EQ(seen.position, anew.position);
  EXPECT_EQ(seen.is_cut, anew.is_cut);
  EXPECT_EQ(words_of(seen), words_of(anew));
}

/// One random design in a window.
class Edits {
 public:
  explicit Edits(uint32_t seed)
      : options_(reading_options(seed)), design_(seed), look_(seed), follower_(path(), options_) {
    save();
  }

  /// Returns false if the design is too large.
  bool begin() { return compare(); }

  /// Returns false if the edit made the design too large, and was taken back.
  bool edit() {
    texts_before_ = written_;
    design_.edit();
    save();
    if (compare()) return true;
    design_.take_back();
    save();
    return false;
  }

  std::string story() const {
    std::string story;
    for (const auto* texts : {&texts_before_, &written_}) {
      story += texts == &written_ ? "======== after\n" : "======== before\n";
      for (const auto& [name, text] : *texts) story += "---- " + name + "\n" + text;
    }
    return story;
  }

 private:
  std::string path() const { return folder_ / "main.scad"; }

  void save() {
    auto texts = design_.texts();
    for (const auto& [name, text] : written_) {
      if (!texts.contains(name)) std::filesystem::remove(folder_ / name);
    }
    for (const auto& [name, text] : texts) {
      if (const auto old = written_.find(name); old != written_.end() && old->second == text)
        continue;
      folder_.write(name, text);
    }
    written_ = std::move(texts);
  }

  /// Returns false if the design is too large.
  bool compare() {
    const DesignVersion fresh = read_fresh(path(), options_, design_.inputs());
    const bool is_large = fresh.design && (fresh.source.tree.nodes->size() > kMostNodes ||
                                           fresh.design->scene.primitives.size() > kMostPrimitives);
    if (is_large) return false;
    const DesignVersion kept = follower_.read(design_.inputs());
    expect_same_version(kept, fresh);
    expect_same_pictures(kept, fresh);
    return true;
  }

  void expect_same_pictures(const DesignVersion& kept, const DesignVersion& fresh) {
    const bool is_drawn = kept.design && fresh.design && !design_.random().chance(6);
    if (!is_drawn || testing::Test::HasFailure()) return;
    look_.change(design_.random(), fresh.design->view_box);
    expect_same_picture(tiles_, look_.order(kept, Technique::kTiles),
                        look_.order(fresh, Technique::kTiles));
    expect_same_picture(cells_, look_.order(kept, Technique::kCells),
                        look_.order(fresh, Technique::kCells));
    const auto probe = [&](const DesignVersion& version) {
      return Probe{
          1, Probe::Purpose::kMeasure, look_.order(version, Technique::kTiles), {24.5, 18.5},
          0, version.source.tree};
    };
    expect_same_finding(tiles_, probe(kept), probe(fresh));
  }

  const frontend::DesignFileOptions options_;
  const frontend::TemporaryFolder folder_;
  EditedDesign design_;
  Look look_;
  Follower follower_;
  Canvas tiles_, cells_;
  std::map<std::string, std::string> written_, texts_before_;
};

std::size_t number_from(const char* name, std::size_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::stoul(value) : otherwise;
}

TEST(Edits, ShowWhatAFreshProcessShows) {
  const std::size_t wanted = number_from(
      "SCADRAY_TEST_EDITS", test_support::full_run() ? 10000u : test_support::sample_size(200));
  auto seed = static_cast<uint32_t>(number_from("SCADRAY_TEST_SEED", 0));
  for (std::size_t edits = 0; edits < wanted; ++seed) {
    Edits design(seed);
    if (!design.begin()) continue;
    for (std::size_t i = 0; i < kEditsPerDesign && !HasFailure(); ++i)
      edits += design.edit() ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << "design " << seed << "\n" << design.story();
  }
  std::printf("%zu edits: %s\n", wanted, test_support::full_run() ? "in full" : "a sample");
}

}  // namespace
}  // namespace window
