#include "packets/segment_lists.hpp"

#include <algorithm>
#include <bit>

namespace csgcore {

void SegmentList::clear() {
  segments_.clear();
  last_ = {};
  winding_ = 0;
  is_complete_ = false;
}

void SegmentList::add(double start, double end, uint32_t start_face, uint32_t end_face) {
  if (!(start < end)) return;
  if (segments_.empty() || segments_.back().end < start) {
    segments_.push_back({start, end, start_face, end_face});
  } else if (segments_.back().end < end) {
    segments_.back().end = end;
    segments_.back().end_face = end_face;
  }
}

void SegmentList::take(std::span<const Crossing> crossings, bool are_last) {
  for (const Crossing& crossing : crossings) {
    const int before = winding_;
    winding_ += crossing.turn;
    if (before == 0) {
      start_ = crossing.t;
      start_face_ = crossing.face;
    } else if (winding_ == 0) {
      add(start_, crossing.t, start_face_, crossing.face);
    }
  }
  if (!crossings.empty()) last_ = crossings.back();
  is_complete_ = are_last;
}

void PacketSegmentLists::clear() {
  for (; begun != 0; begun &= begun - 1) lanes[std::countr_zero(begun)].clear();
  most = 0;
}

PacketSegmentLists& SegmentStore::lists_of(uint32_t primitive) {
  if (place_.size() <= primitive) place_.resize(size_t{primitive} + 1, kNone);
  uint32_t& place = place_[primitive];
  if (place == kNone) {
    place = static_cast<uint32_t>(used_++);
    if (lists_.size() < used_) lists_.push_back(std::make_unique<PacketSegmentLists>());
    primitives_.resize(used_);
    primitives_[place] = primitive;
  }
  return *lists_[place];
}

void SegmentStore::clear_used() {
  for (size_t i = 0; i < used_; ++i) {
    lists_[i]->clear();
    place_[primitives_[i]] = kNone;
  }
  used_ = 0;
}

}  // namespace csgcore
