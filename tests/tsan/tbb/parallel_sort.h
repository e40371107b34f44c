// See stand_in.hpp.
#pragma once

#include "stand_in.hpp"
