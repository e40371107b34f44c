#include "base/decimal_number.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

namespace language {
namespace {

TEST(DecimalNumber, IsTheNearestDouble) {
  EXPECT_EQ(decimal_number("0"), 0.0);
  EXPECT_EQ(decimal_number("5."), 5.0);
  EXPECT_EQ(decimal_number(".5e+1"), 5.0);
  EXPECT_EQ(decimal_number("1.E2"), 100.0);
  EXPECT_EQ(decimal_number("0.1"), 0.1);
  EXPECT_EQ(decimal_number("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(decimal_number("4.9406564584124654e-324"), 4.9406564584124654e-324);
}

TEST(DecimalNumber, IsTheNearestDoubleForEachPlaceOfThePoint) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::string text = std::to_string(random() % 10'000'000'000'000'000u >> random() % 50);
    if (round % 8 != 0) text.insert(random() % (text.size() + 1), ".");
    EXPECT_EQ(decimal_number(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(DecimalNumber, TellsTooSmallFromTooLarge) {
  EXPECT_EQ(decimal_number("1e-400"), 0.0);
  EXPECT_EQ(decimal_number("1e-99999999999999999999"), 0.0);
  EXPECT_EQ(decimal_number("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(decimal_number("0e99999999999999999999"), 0.0);
  EXPECT_EQ(decimal_number("1e400"), std::nullopt);
  EXPECT_EQ(decimal_number("1e+99999999999999999999"), std::nullopt);
  EXPECT_EQ(decimal_number(std::string(400, '9')), std::nullopt);
}

}  // namespace
}  // namespace language
