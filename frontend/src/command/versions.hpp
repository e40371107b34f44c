// What `scadray --version` and `--info` print.
#pragma once

namespace frontend {

void print_version();
void print_info();

}  // namespace frontend
