#include "packets/segment_lists.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace csgcore {
namespace {

using testing::ElementsAre;
using testing::FieldsAre;

std::vector<Crossing> crossings(std::initializer_list<std::pair<double, int>> turns) {
  std::vector<Crossing> result;
  uint32_t face = 0;
  for (const auto& [t, turn] : turns) result.push_back({t, face++, turn});
  return result;
}

SegmentList list_of(std::initializer_list<std::pair<double, int>> turns) {
  SegmentList list;
  list.take(crossings(turns), true);
  return list;
}

TEST(SegmentList, IsWhereTheWindingIsNotZero) {
  EXPECT_THAT(list_of({{1, 1}, {2, -1}, {3, 1}, {4, -1}}).segments(),
              ElementsAre(FieldsAre(1, 2, 0u, 1u), FieldsAre(3, 4, 2u, 3u)));
  // Inside out, and shells that overlap.
  EXPECT_THAT(list_of({{1, -1}, {2, 1}}).segments(), ElementsAre(FieldsAre(1, 2, 0u, 1u)));
  EXPECT_THAT(list_of({{1, 1}, {2, 1}, {3, -1}, {4, -1}}).segments(),
              ElementsAre(FieldsAre(1, 4, 0u, 3u)));
}

TEST(SegmentList, HasNoSegmentsWithoutALength) {
  EXPECT_TRUE(list_of({{1, 1}, {1, -1}}).segments().empty());
}

TEST(SegmentList, JoinsSegmentsThatTouch) {
  EXPECT_THAT(list_of({{1, 1}, {2, -1}, {2, 1}, {3, -1}}).segments(),
              ElementsAre(FieldsAre(1, 3, 0u, 3u)));
}

TEST(SegmentList, GrowsByParts) {
  SegmentList list;
  const std::vector<Crossing> all = crossings({{1, 1}, {2, 1}, {3, -1}, {4, -1}, {5, 1}, {6, -1}});
  list.take(std::span(all).first(2), false);
  EXPECT_TRUE(list.segments().empty());
  EXPECT_EQ(list.last().t, 2);
  list.take(std::span(all).subspan(2, 3), false);
  EXPECT_EQ(list.segments().size(), 1u);
  EXPECT_FALSE(list.is_complete());
  list.take(std::span(all).subspan(5), true);
  EXPECT_THAT(list.segments(), ElementsAre(FieldsAre(1, 4, 0u, 3u), FieldsAre(5, 6, 4u, 5u)));
  EXPECT_TRUE(list.is_complete());
}

TEST(SegmentList, CountsWhatHasEnded) {
  const SegmentList list = list_of({{1, 1}, {2, -1}, {3, 1}, {4, -1}});
  EXPECT_EQ(list.ended_at(1.5), 0u);
  EXPECT_EQ(list.ended_at(2), 1u);
  EXPECT_EQ(list.ended_at(9), 2u);
}

TEST(SegmentList, MakesSheetsOfCrossingsThatDoNotCancel) {
  SegmentList list;
  list.take_sheets(crossings({{1, 1}, {2, 1}, {2.25, -1}}), [](const Crossing&) { return 0.5; });
  EXPECT_THAT(list.segments(), ElementsAre(FieldsAre(1, 1.5, 0u, 0u), FieldsAre(2, 2.75, 1u, 2u)));
  EXPECT_TRUE(list.is_complete());
}

TEST(CrossingSearch, KeepsTheNextOnesAndTheirEquals) {
  CrossingSearch search;
  search.most = 2;
  search.lanes[3].after = {1, 7, 1};
  for (const Crossing& crossing : {Crossing{5, 0, 1}, Crossing{1, 7, 1}, Crossing{1, 6, 1},
                                   Crossing{2, 1, 1}, Crossing{1, 8, 1}, Crossing{2, 0, -1}}) {
    search.add(3, crossing);
  }
  EXPECT_THAT(search.lanes[3].found,
              ElementsAre(FieldsAre(1, 8u, 1), FieldsAre(2, 0u, -1), FieldsAre(2, 1u, 1)));
  EXPECT_EQ(search.add(3, {9, 0, 1}), 2);
}

TEST(SegmentStore, ForgetsWhenItIsCleared) {
  SegmentStore store;
  PacketSegmentLists& lists = store.lists_of(4);
  lists.begun = 2;
  lists.lanes[1].take(crossings({{1, 1}, {2, -1}}), true);
  EXPECT_EQ(&store.lists_of(4), &lists);
  EXPECT_NE(&store.lists_of(0), &lists);
  EXPECT_EQ(store.lists_of(4).lanes[1].segments().size(), 1u);
  store.clear();
  for (const uint32_t primitive : {0u, 4u}) {
    EXPECT_TRUE(store.lists_of(primitive).lanes[1].segments().empty());
    EXPECT_FALSE(store.lists_of(primitive).lanes[1].is_complete());
  }
}

}  // namespace
}  // namespace csgcore
