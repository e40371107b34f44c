// Tests the judge itself: what it accepts, and what it calls wrong, undecided and speckle.
#include "judge.hpp"

#include <gtest/gtest.h>

#include "cases.hpp"
#include "suite.hpp"

namespace stress {
namespace {

using csgcore::Hits;

constexpr uint32_t kWidth = 32, kHeight = 24;
constexpr size_t pixel(uint32_t x, uint32_t y) { return size_t{y} * kWidth + x; }
constexpr size_t kMiddle = pixel(16, 12);

/// A big ball and a small one beside it, from the front.
class JudgeTest : public testing::Test {
 protected:
  JudgeTest()
      : scene_((ball(5) + ball(1, {0, 5, 5})).scene()),
        view_(view_along(camera_box(scene_), {kWidth, kHeight}, Projection::kOrthographic, 0, 3)),
        oracle_(scene_, view_),
        picture_(perfect()) {}

  Hits perfect() const {
    Hits hits{kWidth, kHeight, {}, {}, {}, {}};
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
      const oracle::ExactHit& hit = oracle_.hit(i);
      hits.primitive.push_back(hit.primitive);
      hits.s.push_back(hit.s.lower);
      hits.position.emplace_back(hit.position);
      hits.normal.emplace_back(hit.normal);
    }
    return hits;
  }
  void miss(size_t i) {
    picture_.primitive[i] = Hits::kMiss;
    picture_.s[i] = std::numeric_limits<double>::infinity();
  }
  Tally judged(const Tolerance& tolerance = kDoubleTolerance) {
    return judge(oracle_, picture_, tolerance);
  }

  Scene scene_;
  View view_;
  Oracle oracle_;
  Hits picture_;
};

TEST_F(JudgeTest, LetsARightPicturePass) {
  const Tally tally = judged();
  EXPECT_EQ(tally.pixels, size_t{kWidth} * kHeight);
  EXPECT_EQ(tally.hits, oracle_.hits());
  EXPECT_GT(tally.hits, 100u);
  EXPECT_LT(tally.hits, tally.pixels - 100);
  EXPECT_EQ(tally.wrong_pixels(), 0u);
  EXPECT_EQ(tally.undecided, 0u);
  EXPECT_EQ(tally.position_errors.count(), tally.hits);
  EXPECT_LT(tally.position_errors.largest(), 1e-15);
  EXPECT_TRUE(tally.first_wrong.empty());
}

TEST_F(JudgeTest, TellsWhatIsWrong) {
  const double size = oracle_.model_size();
  const auto verdict_of = [&](auto&& spoil) {
    picture_ = perfect();
    spoil();
    const Tally tally = judged();
    EXPECT_EQ(tally.wrong_pixels(), 1u);
    EXPECT_EQ(tally.undecided, 0u);
    EXPECT_FALSE(tally.first_wrong.empty());
    for (size_t i = 0; i < kVerdicts; ++i) {
      if (tally.wrong[i]) return Verdict(i);
    }
    return Verdict::kRight;
  };
  EXPECT_EQ(verdict_of([&] { miss(kMiddle); }), Verdict::kWrongHit);
  EXPECT_EQ(verdict_of([&] { picture_.primitive[0] = 0; }), Verdict::kWrongHit);
  EXPECT_EQ(verdict_of([&] { picture_.primitive[kMiddle] = 1; }), Verdict::kWrongPrimitive);
  EXPECT_EQ(verdict_of([&] { picture_.position[kMiddle].x += 3e-9 * size; }),
            Verdict::kWrongPosition);
  EXPECT_EQ(verdict_of([&] { picture_.position[kMiddle].y = std::nan(""); }),
            Verdict::kWrongPosition);
  EXPECT_EQ(verdict_of([&] { picture_.s[kMiddle] += 3e-9 * size; }), Verdict::kWrongPosition);
  EXPECT_EQ(verdict_of([&] { picture_.normal[kMiddle] *= -1; }), Verdict::kWrongNormal);
}

TEST_F(JudgeTest, MeasuresWhatIsRight) {
  const double size = oracle_.model_size();
  for (csgcore::Vec3& p : picture_.position) p.x += 1e-12 * size;
  picture_.position[kMiddle].x += 1e-10 * size;
  const Tally tally = judged();
  EXPECT_EQ(tally.wrong_pixels(), 0u);
  EXPECT_NEAR(tally.position_errors.median(), 1e-12, 6e-14);
  EXPECT_NEAR(tally.position_errors.largest(), 1.01e-10, 1e-12);
}

TEST_F(JudgeTest, SpeckleIsWhatItsNeighboursGiveAway) {
  miss(kMiddle);
  EXPECT_EQ(judged().speckle, 1u);
  picture_.primitive[kMiddle] = 1;
  EXPECT_EQ(judged().speckle, 1u);
  // With one wrong neighbour three right ones are left, which suffice; with two wrong ones they do
  // not.
  miss(pixel(17, 12));
  EXPECT_EQ(judged().speckle, 2u);
  miss(pixel(16, 11));
  miss(pixel(17, 11));
  EXPECT_EQ(judged().speckle, 0u);
  EXPECT_EQ(judged().wrong_pixels(), 4u);
}

TEST_F(JudgeTest, AWrongPixelOnAnEdgeIsNoSpeckle) {
  // The outermost hit of the middle row has hits above, below and inwards, and a miss outwards. A
  // corner of the silhouette has two of each.
  int edges = 0;
  for (uint32_t y = 1; y + 1 < kHeight; ++y) {
    for (uint32_t x = 1; x + 1 < kWidth; ++x) {
      int same = 0;
      for (const size_t i : {pixel(x - 1, y), pixel(x + 1, y), pixel(x, y - 1), pixel(x, y + 1)}) {
        same += oracle_.hit(i).primitive == oracle_.hit(pixel(x, y)).primitive;
      }
      picture_ = perfect();
      picture_.primitive[pixel(x, y)] = oracle_.hit(pixel(x, y)).hit() ? Hits::kMiss : 0;
      const Tally tally = judged();
      ASSERT_EQ(tally.speckle + tally.undecided, same >= 3 ? 1u : 0u) << x << ' ' << y;
      edges += same < 3;
    }
  }
  EXPECT_GT(edges, 5);
}

TEST(JudgeUndecidedTest, IsWhereThereIsADoubt) {
  // Of the four rows of pixels that see the rod, the topmost passes its lid by less than the
  // displacement.
  const Scene scene = rod(-1, 0.75 + 3e-12, 8).scene();
  View view = view_along(Box{Vec3{-16.0}, Vec3{16.0}}, {64, 64}, Projection::kOrthographic, 0, 2);
  view.half_height = 16;
  Oracle oracle(scene, view);
  Hits picture{64, 64, {}, {}, {}, {}};
  for (size_t i = 0; i < 64 * 64; ++i) {
    picture.primitive.push_back(Hits::kMiss);
    picture.s.push_back(std::numeric_limits<double>::infinity());
    picture.position.emplace_back(0.0);
    picture.normal.emplace_back(0.0);
  }
  const Tally tally = judge(oracle, picture, kDoubleTolerance);
  const uint64_t row = tally.hits / 4;
  EXPECT_EQ(row, 32u);  // from −7.75 to 7.75
  EXPECT_EQ(tally.undecided, row);
  EXPECT_EQ(tally.undecided_pixels.size(), 20u);
  EXPECT_EQ(tally.wrong_pixels(), 3 * row);
}

TEST(ErrorHistogramTest, MediansAndMergesAsAListDoes) {
  ErrorHistogram none, some, more;
  EXPECT_EQ(none.median(), 0);
  for (int i = 0; i < 10; ++i) some.add(0.0);
  some.add(1e-5);
  EXPECT_EQ(some.median(), 0);
  EXPECT_EQ(some.largest(), 1e-5);
  for (int i = 1; i <= 101; ++i) more.add(1e-12 * i);
  EXPECT_NEAR(more.median(), 51e-12, 3e-12);
  for (int i = 0; i < 300; ++i) some.add(2e30);
  more.add(some);
  EXPECT_EQ(more.count(), 412u);
  EXPECT_EQ(more.largest(), 2e30);
  EXPECT_GT(more.median(), 1e5);
}

TEST(JudgeImageTest, IdsAreTakenBackToPrimitives) {
  Scene scene = (ball(1) + ball(2)).scene();
  scene.primitives[0].id = 7;
  scene.primitives[1].id = 3;
  csgcore::Image image;
  image.width_px = 3;
  image.height_px = 1;
  image.id = {3, csgcore::kNoPrimitive, 7};
  image.z = {1, std::numeric_limits<float>::infinity(), 2};
  image.position.assign(3, glm::vec3(1, 2, 3));
  image.normal.assign(3, glm::vec3(0, 0, 1));
  const Hits hits = hits_of(image, scene);
  EXPECT_EQ(hits.primitive, (std::vector<uint32_t>{1, Hits::kMiss, 0}));
  EXPECT_EQ(hits.s[2], 2);
}

// --- The suite ---

TEST(StressSuiteTest, HasItsCases) {
  size_t cases = 0, coincident = 0;
  for (const Family& family : families()) {
    cases += family.cases.size();
    coincident += family.is_coincident ? family.cases.size() : 0;
    for (const Case& one : family.cases) {
      if (one.only_full_run) continue;
      EXPECT_EQ(one.cameras(one.make(), {96, 72}).size(), 3u) << family.name << '/' << one.name;
    }
  }
  EXPECT_GE(cases, 40u);
  EXPECT_GE(coincident, 20u);
}

}  // namespace
}  // namespace stress
