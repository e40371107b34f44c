#include "drawings/drawing.hpp"

#include "drawings/disjoint_figures.hpp"

namespace frontend {

void leave_out_tangles(const std::string& name, bool are_others_left_out, Drawing& drawing) {
  if (std::erase_if(drawing.figures, is_tangle) == 0 && !are_others_left_out) return;
  drawing.problems.push_back(
      {"Outlines of '" + name + "' are left out: their edges cross too often",
       "draw outlines that do not cross"});
}

}  // namespace frontend
