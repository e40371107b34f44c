// Appends instructions to a Code and counts the slots that are in use.
#pragma once

#include <algorithm>
#include <cstdint>

#include "code/code.hpp"

namespace language {

class CodeBuilder {
 public:
  explicit CodeBuilder(Code& code) : code_(code) {}

  Code& code() const { return code_; }
  /// Returns the slot that the next value is pushed to.
  uint32_t depth() const { return depth_; }
  void set_depth(uint32_t depth) {
    depth_ = depth;
    code_.deepest = std::max(code_.deepest, depth_);
  }
  uint32_t here() const { return static_cast<uint32_t>(code_.instructions.size()); }

  /// Appends an instruction that changes the number of values by `pushed`. Returns its position.
  uint32_t emit(Op op, Place place, int pushed, uint32_t b = 0, uint32_t a = 0, uint16_t flag = 0) {
    code_.instructions.push_back({op, flag, a, b});
    code_.places.push_back(place);
    set_depth(depth_ + static_cast<uint32_t>(pushed));
    return here() - 1;
  }
  /// Removes the last instruction, which has pushed one value and to which nothing jumps.
  Instruction take_back() {
    const Instruction last = code_.instructions.back();
    code_.instructions.pop_back();
    code_.places.pop_back();
    --depth_;
    return last;
  }
  /// Lets the jump at a position go to the next instruction.
  void land(uint32_t position) { code_.instructions[position].b = here(); }
  Instruction& at(uint32_t position) { return code_.instructions[position]; }

  void constant(Value value, Place place) {
    code_.constants.push_back(std::move(value));
    emit(Op::kConstant, place, 1, static_cast<uint32_t>(code_.constants.size() - 1));
  }

 private:
  Code& code_;
  uint32_t depth_ = 0;
};

}  // namespace language
