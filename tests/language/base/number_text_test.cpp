#include "base/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace language {
namespace {

std::string echo(double number) {
  std::string text;
  append_echo_number(text, number);
  return text;
}

std::string general(double number) {
  std::string text;
  append_general_number(text, number);
  return text;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(EchoNumber, HasSixDigits) {
  EXPECT_EQ(echo(0), "0");
  EXPECT_EQ(echo(-0.0), "0");
  EXPECT_EQ(echo(1.0 / 3), "0.333333");
  EXPECT_EQ(echo(-2.5), "-2.5");
  EXPECT_EQ(echo(999999), "999999");
  EXPECT_EQ(echo(100), "100");
  EXPECT_EQ(echo(0.00001), "0.00001");
}

TEST(EchoNumber, RoundsExactTiesAwayFromZero) {
  EXPECT_EQ(echo(123456.5), "123457");
  EXPECT_EQ(echo(-123456.5), "-123457");
  EXPECT_EQ(echo(0.1234565), "0.123456");  // the double is below the tie
  EXPECT_EQ(echo(1234565), "1.23457e+6");
  EXPECT_EQ(echo(12.34375), "12.3438");
  EXPECT_EQ(echo(999999.5), "1e+6");
  EXPECT_EQ(echo(1234565e10), "1.23457e+16");
}

TEST(EchoNumber, WritesExponentsWithoutPadding) {
  EXPECT_EQ(echo(1e6), "1e+6");
  EXPECT_EQ(echo(1e-6), "1e-6");
  EXPECT_EQ(echo(1e100), "1e+100");
  EXPECT_EQ(echo(5e-324), "4.94066e-324");
}

TEST(EchoNumber, NamesWhatIsNoNumber) {
  EXPECT_EQ(echo(kInfinity), "inf");
  EXPECT_EQ(echo(-kInfinity), "-inf");
  EXPECT_EQ(echo(-std::nan("")), "nan");
}

TEST(GeneralNumber, IsWhatPrintfWrites) {
  for (const double number :
       {0.0, -0.0, 1.0, 123456.5, 123455.5, 0.0001, 0.00001, 1e5, 1e6, 1234565.0, 0.1, 1e100,
        -2.5e-7, 5e-324, 999999.5, 1e15, 12.5, kInfinity, -kInfinity}) {
    char expected[32];
    std::snprintf(expected, sizeof expected, "%g", number);
    EXPECT_EQ(general(number), expected);
  }
  EXPECT_EQ(general(-std::nan("")), "-nan");
}

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
