// Part of every test program. What tests expect was written by the installed OpenSCAD 2021.01, so
// designs are in its language, in this process and in those that it starts, unless a test or
// whoever runs it says otherwise.
#include <cstdlib>

namespace {

[[maybe_unused]] const int kIsSet = setenv("SCADRAY_LANGUAGE", "2021.01", 0);

}  // namespace
