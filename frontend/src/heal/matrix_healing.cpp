#include "heal/matrix_healing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "base/angles.hpp"
#include "language/degrees.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Vec3;

// Rounding noise of double arithmetic, ours and OpenSCAD's, in a matrix with entries of at most 1:
// a few dozen operations of 1.1e-16 each. It includes what OpenSCAD prints for 0 (5.55112e-17).
constexpr double kDoubleNoise = 1e-14;
// A computed entry may lie exactly on an end of its digits' interval, which belongs to the
// interval.
constexpr double kTieSlack = 1 + 1e-9;
// An angle with at most kMeantDecimals decimals (degrees) is taken for the design's own. A rounded
// matrix tells an angle to about 6e-5 degrees, so that by chance one angle in 170 has two decimals;
// with three it would be one in 17, so that those are healed, but still count as rounded.
constexpr int kMeantDecimals = 2;
constexpr int kMostDecimals = 3;
// Loops over q copies turn by parts of a full turn, 360·i/q degrees.
constexpr int kLeastParts = 7;
constexpr int kMostParts = 97;
// Beside a rotation, scales of up to this many digits are taken for the design's own.
constexpr int kMeantScaleDigits = 3;
// Rotation axes and mirror normals with integer components up to this are taken for the design's
// own.
constexpr int kMostAxisComponent = 10;
// Near y = ±90 degrees (cos y below this) x and z turn about the same axis, and only their sum is
// known. Such a matrix is healed as y = ±90 exactly, or without looking for angles.
constexpr double kGimbalCosine = 1e-3;
// Parameters of turning a matrix into its digits' intervals. kWithin: the share of each interval
// that is aimed at, since a step ends at the end of one. kFinestShare: intervals finer than this
// share of the widest have no more weight. kMostSteps: after so many there is hardly a solution.
// kMostRounds: what one round leaves is of second order, 1e-13 of an entry that is 0.
constexpr double kWithin = 0.999;
constexpr double kFinestShare = 1e-2;
constexpr int kMostSteps = 100;
constexpr int kMostRounds = 3;
constexpr int kMostPolarSteps = 30;
// The next step would change the matrix by half of this, squared.
constexpr double kPolarChange = 1e-8;

template <typename Function>
void for_each_entry(Function function) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) function(column, row);
  }
}

double power_of_ten(int exponent) {
  constexpr int kTable = 30;
  static const std::array<double, 2 * kTable + 1> powers = [] {
    std::array<double, 2 * kTable + 1> table;
    for (int i = -kTable; i <= kTable; ++i) table[i + kTable] = std::pow(10.0, i);
    return table;
  }();
  if (exponent < -kTable || exponent > kTable) return std::pow(10.0, exponent);
  return powers[exponent + kTable];
}

/// Returns the exponent e with 10^e ≤ size < 10^(e+1). Far from 1 it may be one off just at a power
/// of ten.
int decimal_exponent(double size) {
  constexpr int kNear = 6;  // nearly all entries are in this range, where a search beats the
                            // logarithm
  if (size < power_of_ten(-kNear) || size >= power_of_ten(kNear)) {
    return static_cast<int>(std::floor(std::log10(size)));
  }
  int exponent = 0;
  while (size < power_of_ten(exponent)) --exponent;
  while (size >= power_of_ten(exponent + 1)) ++exponent;
  return exponent;
}

double largest_entry(const Mat3& m) {
  double largest = 0;
  for_each_entry([&](int c, int r) { largest = std::max(largest, m[c][r]); });
  return largest;
}

int64_t nearest_integer(double value) {
  return static_cast<int64_t>(value < 0 ? value - 0.5 : value + 0.5);
}

/// Returns whether every entry of the candidate would be printed as in the file.
bool prints_alike(const Mat3& candidate, const Mat3& file, const Mat3& half) {
  bool alike = true;
  for_each_entry([&](int c, int r) {
    const double allowed = half[c][r] * kTieSlack + kDoubleNoise;
    alike = alike && std::abs(candidate[c][r] - file[c][r]) <= allowed;
  });
  return alike;
}

/// Returns the nearest orthogonal matrix (polar decomposition by Newton's iteration).
Mat3 nearest_orthogonal(Mat3 m) {
  for (int step = 0; step < kMostPolarSteps; ++step) {
    const Mat3 next = 0.5 * (m + glm::transpose(glm::inverse(m)));
    double change = 0;
    for_each_entry(
        [&](int c, int r) { change = std::max(change, std::abs(next[c][r] - m[c][r])); });
    m = next;
    if (change <= kPolarChange) break;
  }
  return m;
}

/// Returns the matrix with `cross_product(w)·v = w × v`.
Mat3 cross_product(const Vec3& w) {
  return Mat3(Vec3(0, w.z, -w.y), Vec3(-w.z, 0, w.x), Vec3(w.y, -w.x, 0));
}

/// A small change that brings a matrix into its digits' intervals.
struct Correction {
  Vec3 turn;  // small angles
  double growth;
};

/// Finds the correction of a similarity S, S·(1 + [turn]× + growth) to first order. It starts from
/// least squares in units of the intervals. As long as an interval is missed, it then moves back
/// from the one that is missed by most (the relaxation method of Agmon, and of Motzkin and
/// Schoenberg, 1954).
Correction find_correction(const Mat3& similarity, const Mat3& file, const Mat3& half,
                           bool free_scale) {
  // The derivatives of an entry of column c by the turns about axis c + 1 and axis c + 2, and by
  // growth.
  Mat3 by_next, by_second, by_growth(0.0), per_length;
  const double finest = kFinestShare * largest_entry(half) + kDoubleNoise;
  glm::dmat4 squares(0.0);
  glm::dvec4 right(0.0);
  for (int c = 0; c < 3; ++c) {
    by_next[c] = -similarity[(c + 2) % 3];
    by_second[c] = similarity[(c + 1) % 3];
    if (free_scale) by_growth[c] = similarity[c];
    for (int r = 0; r < 3; ++r) {
      glm::dvec4 slope(0.0);
      slope[(c + 1) % 3] = by_next[c][r];
      slope[(c + 2) % 3] = by_second[c][r];
      slope[3] = by_growth[c][r];
      const double length = glm::length(slope);
      per_length[c][r] = length <= kDoubleNoise ? 0 : 1 / length;
      const double weight = 1 / std::max(half[c][r], finest);
      const glm::dvec4 weighted = slope * (weight * weight);
      squares += glm::outerProduct(slope, weighted);
      right += weighted * (file[c][r] - similarity[c][r]);
    }
  }
  if (!free_scale) squares[3][3] = 1;
  glm::dvec4 found = glm::inverse(squares) * right;

  const Mat3 least = file - kWithin * half - similarity;
  const Mat3 most = file + kWithin * half - similarity;
  for (int step = 0; step < kMostSteps; ++step) {
    double furthest = 0;  // as a length of turn and growth
    double excess = 0;
    int column = 0, row = 0;
    for_each_entry([&](int c, int r) {
      const double change = by_next[c][r] * found[(c + 1) % 3] +
                            by_second[c][r] * found[(c + 2) % 3] + by_growth[c][r] * found[3];
      const double passed =
          std::max(change - most[c][r], 0.0) + std::min(change - least[c][r], 0.0);
      const double distance = std::abs(passed) * per_length[c][r];
      if (distance <= furthest || std::abs(passed) <= kDoubleNoise) return;
      furthest = distance;
      excess = passed;
      column = c;
      row = r;
    });
    if (furthest == 0) break;
    const double by = excess * per_length[column][row] * per_length[column][row];
    found[(column + 1) % 3] -= by * by_next[column][row];
    found[(column + 2) % 3] -= by * by_second[column][row];
    found[3] -= by * by_growth[column][row];
  }
  return {Vec3(found), found[3]};
}

/// Returns a rotation or mirror, times a factor near 1 if the scale is free, within the digits'
/// intervals.
std::optional<Mat3> similarity_within(const Mat3& file, const Mat3& half, bool free_scale) {
  Mat3 unit = nearest_orthogonal(file);
  double scale = 1;
  for (int round = 0; round < kMostRounds; ++round) {
    const Correction correction = find_correction(unit * scale, file, half, free_scale);
    unit = nearest_orthogonal(unit + unit * cross_product(correction.turn));
    scale *= 1 + correction.growth;
    if (prints_alike(unit * scale, file, half)) return unit * scale;
  }
  return std::nullopt;
}

/// Returns whether each row and column has one nonzero entry: a scale, mirror or quarter turn, with
/// any factors.
bool is_axis_aligned(const Mat3& m) {
  int rows = 0;
  for (int column = 0; column < 3; ++column) {
    int nonzero = 0;
    for (int row = 0; row < 3; ++row) {
      if (m[column][row] == 0) continue;
      ++nonzero;
      rows |= 1 << row;
    }
    if (nonzero != 1) return false;
  }
  return rows == 7;
}

struct Scale {
  double factor;
  bool is_short;  // the factor is a short decimal number, taken for the design's own
};

/// Returns the common factor if, within the digits, the columns are orthogonal and of one length:
/// the shortest decimal number that explains their lengths, or else their mean.
std::optional<Scale> uniform_scale(const Mat3& file, const Mat3& half) {
  std::array<double, 3> squares{};
  double slack = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      double allowed = kDoubleNoise;
      for (int k = 0; k < 3; ++k) {
        allowed += half[i][k] * std::abs(file[j][k]) + std::abs(file[i][k]) * half[j][k];
      }
      const double product = glm::dot(file[i], file[j]);
      if (i == j) {
        squares[i] = product;
        slack = std::max(slack, allowed);
      } else if (std::abs(product) > allowed) {
        return std::nullopt;
      }
    }
  }
  const auto [least, most] = std::minmax_element(squares.begin(), squares.end());
  if (*most - *least > 2 * slack || !(*least > 0)) return std::nullopt;
  const double scale = std::sqrt((squares[0] + squares[1] + squares[2]) / 3);
  const int exponent = decimal_exponent(scale);
  for (int digits = 0; digits < kMeantScaleDigits; ++digits) {
    const double unit = power_of_ten(digits - exponent);
    const double rounded = static_cast<double>(nearest_integer(scale * unit)) / unit;
    if (std::abs(rounded * rounded - scale * scale) <= slack) return Scale{rounded, true};
  }
  return Scale{scale, false};
}

/// A rotation that is printed as in the file.
struct Recognised {
  Mat3 rotation;
  bool meant;  // simple enough to be the design's own
};

/// Rounds the angles to that many decimals; nothing unless all three stay within `slack_deg`.
std::optional<Vec3> rounded_angles(const Vec3& angles_deg, int decimals, double slack_deg) {
  const double unit = power_of_ten(decimals);
  Vec3 rounded;
  for (int i = 0; i < 3; ++i) {
    rounded[i] = static_cast<double>(nearest_integer(angles_deg[i] * unit)) / unit;
    if (std::abs(rounded[i] - angles_deg[i]) > slack_deg) return std::nullopt;
  }
  return rounded;
}

/// Returns the angles with one of them rounded to 360·i/q degrees, if the other two are 0.
std::optional<Vec3> part_of_turn(const Vec3& angles_deg, double slack_deg) {
  int turning = -1;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(angles_deg[i]) <= slack_deg) continue;
    if (turning >= 0) return std::nullopt;
    turning = i;
  }
  if (turning < 0) return std::nullopt;
  for (int parts = kLeastParts; parts <= kMostParts; ++parts) {
    const double part = std::round(angles_deg[turning] * parts / 360) * 360 / parts;
    if (std::abs(part - angles_deg[turning]) > slack_deg) continue;
    Vec3 result(0.0);
    result[turning] = part;
    return result;
  }
  return std::nullopt;
}

/// Returns the angles with euler_rotation(angles) = m; at y = ±90 degrees, those with z = 0.
Vec3 euler_angles_deg(const Mat3& m, double cos_y) {
  const double y = std::atan2(-m[0][2], cos_y);
  if (cos_y < kGimbalCosine) {
    return Vec3(std::atan2(m[0][2] < 0 ? m[1][0] : -m[1][0], m[1][1]), y, 0) / kDegree;
  }
  return Vec3(std::atan2(m[1][2], m[2][2]), y, std::atan2(m[0][1], m[0][0])) / kDegree;
}

std::optional<Recognised> recognise_euler(const Mat3& file, const Mat3& half, double widest) {
  const double cos_y = std::hypot(file[0][0], file[0][1]);
  const double slack_deg = 2 * widest / std::max(cos_y, kGimbalCosine) / kDegree;
  Vec3 angles = euler_angles_deg(file, cos_y);
  if (cos_y < kGimbalCosine) angles.y = angles.y > 0 ? 90 : -90;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals) {
    const std::optional<Vec3> rounded = rounded_angles(angles, decimals, slack_deg);
    if (!rounded) continue;
    const Mat3 rotation = euler_rotation(*rounded);
    if (prints_alike(rotation, file, half)) return Recognised{rotation, decimals <= kMeantDecimals};
    break;
  }
  if (const std::optional<Vec3> part = part_of_turn(angles, slack_deg)) {
    const Mat3 rotation = euler_rotation(*part);
    if (prints_alike(rotation, file, half)) return Recognised{rotation, true};
  }
  return std::nullopt;
}

/// n·nᵀ.
Mat3 projector(const Vec3& n) { return glm::outerProduct(n, n); }

/// Returns the direction with small integer components that is within `slack` of the unit vector.
std::optional<Vec3> simple_direction(const Vec3& direction, double slack) {
  const Vec3 size = glm::abs(direction);
  const Vec3 relative = direction / std::max({size.x, size.y, size.z});
  for (int largest = 1; largest <= kMostAxisComponent; ++largest) {
    Vec3 whole;
    double distance = 0;
    for (int i = 0; i < 3; ++i) {
      const double component = relative[i] * largest;
      whole[i] = static_cast<double>(nearest_integer(component));
      distance = std::max(distance, std::abs(whole[i] - component));
    }
    // Components relative to the largest are at least the unit vector's, so that no direction
    // within slack is rejected.
    if (distance > 4 * largest * slack) continue;
    const Vec3 unit = glm::normalize(whole);
    if (glm::length(unit - direction) <= slack) return unit;
  }
  return std::nullopt;
}

/// Recognises a mirror, I − 2·n·nᵀ, or a half turn, 2·n·nᵀ − I; `sign` is −1 for the half turn.
std::optional<Recognised> recognise_reflection(const Mat3& file, const Mat3& half, double widest,
                                               double sign) {
  const Mat3 square = 0.5 * (Mat3(1.0) - sign * file);
  int column = 0;
  for (int i = 1; i < 3; ++i) {
    if (square[i][i] > square[column][column]) column = i;
  }
  const double length = glm::length(square[column]);
  if (length < 0.5) return std::nullopt;  // a projector's longest column has at least length 1/√3
  const std::optional<Vec3> normal = simple_direction(square[column] / length, 4 * widest / length);
  if (!normal) return std::nullopt;
  const Mat3 candidate = sign * (Mat3(1.0) - 2.0 * projector(*normal));
  if (!prints_alike(candidate, file, half)) return std::nullopt;
  return Recognised{candidate, true};
}

/// Recognises OpenSCAD's rotate(a, v) about an axis with small integer components.
std::optional<Recognised> recognise_axis_angle(const Mat3& file, const Mat3& half, double widest) {
  const Vec3 twice_sine(file[1][2] - file[2][1], file[2][0] - file[0][2], file[0][1] - file[1][0]);
  const double length = glm::length(twice_sine);
  if (length <= 8 * widest) return recognise_reflection(file, half, widest, -1);
  const std::optional<Vec3> axis = simple_direction(twice_sine / length, 4 * widest / length);
  if (!axis) return std::nullopt;
  const double trace = file[0][0] + file[1][1] + file[2][2];
  const Vec3 angle(std::atan2(length, trace - 1) / kDegree, 0, 0);
  const double slack_deg = 4 * widest / kDegree;
  for (int decimals = 0; decimals <= kMeantDecimals; ++decimals) {
    const std::optional<Vec3> rounded = rounded_angles(angle, decimals, slack_deg);
    if (!rounded) continue;
    const double sine = language::sine_of_degrees(rounded->x);
    const double cosine = language::cosine_of_degrees(rounded->x);
    const Mat3 rotation =
        cosine * Mat3(1.0) + (1 - cosine) * projector(*axis) + sine * cross_product(*axis);
    if (prints_alike(rotation, file, half)) return Recognised{rotation, true};
    break;
  }
  return std::nullopt;
}

std::optional<Recognised> recognise(const Mat3& file, const Mat3& half) {
  const double widest = largest_entry(half);
  if (glm::determinant(file) < 0) return recognise_reflection(file, half, widest, 1);
  if (const auto euler = recognise_euler(file, half, widest)) return euler;
  return recognise_axis_angle(file, half, widest);
}

/// How far the entries of a matrix may be from the design's.
struct Rounding {
  Mat3 half{0.0};  // half the interval of each
  Mat3 kept{0.0};  // the same where the entry shows that it is rounded; else 0
};

/// Keeps an axis-aligned or general matrix, with the rounding of its digits as its errors.
void keep_linear(HealedMatrix& matrix, const Rounding& rounding) {
  matrix.linear_error = rounding.kept;
  matrix.exact = largest_entry(rounding.kept) == 0;
}

void heal_linear(HealedMatrix& matrix, const Rounding& rounding) {
  const Mat3 file = matrix.map.linear;
  const Mat3& half = rounding.half;
  if (is_axis_aligned(file)) return keep_linear(matrix, rounding);
  const std::optional<Scale> scale = uniform_scale(file, half);
  if (!scale) return keep_linear(matrix, rounding);
  const Mat3 unit_file = file / scale->factor;
  const Mat3 unit_half = half / scale->factor;
  std::optional<Recognised> found;
  if (scale->is_short) found = recognise(unit_file, unit_half);
  if (!found) {
    const auto nearest = similarity_within(unit_file, unit_half, !scale->is_short);
    if (nearest) found = Recognised{*nearest, false};
  }
  if (found) matrix.map.linear = found->rotation * scale->factor;
  if (found && found->meant) return;
  // Both the design's matrix and the healed one lie within half a unit of the file's.
  matrix.linear_error = 2.0 * half;
  matrix.exact = largest_entry(half) == 0;
}

void bound_translation(HealedMatrix& matrix) {
  const Vec3& translation = matrix.map.translation;
  bool rounded = false;
  std::array<Digits, 3> digits;
  for (int i = 0; i < 3; ++i) {
    digits[i] = digits_of(translation[i]);
    rounded = rounded || digits[i].count == 6;
  }
  if (!rounded) return;
  for (int i = 0; i < 3; ++i) {
    // Beside a number with six digits, a number with five counts as rounded, too: by chance, one
    // rounded number in ten has a sixth digit of 0.
    if (digits[i].count >= 5) matrix.translation_error[i] = digits[i].half_unit;
  }
  matrix.exact = false;
}

Rounding rounding_to_six_digits(const Mat3& file) {
  Rounding rounding;
  for_each_entry([&](int c, int r) {
    const Digits digits = digits_of(file[c][r]);
    rounding.half[c][r] = digits.half_unit;
    if (digits.count == 6) rounding.kept[c][r] = digits.half_unit;
  });
  return rounding;
}

}  // namespace

Digits digits_of(double value) {
  double size = std::abs(value);
  if (size == 0) return {0, 0};
  const int exponent = decimal_exponent(size);
  const double unit = power_of_ten(exponent - 5);
  size *= power_of_ten(5 - exponent);  // so that six digits are before the point
  int64_t integer = nearest_integer(size);
  // Reading a decimal number and scaling it cost a few units in the 16th digit, 1e-10 here; a
  // seventh digit would be at least 0.1.
  constexpr double kReadingNoise = 1e-6;
  if (std::abs(size - static_cast<double>(integer)) > kReadingNoise) return {7, 0};
  int count = 6;
  while (count > 1 && integer % 10 == 0) {
    integer /= 10;
    --count;
  }
  // A power of ten has the unit of the numbers below it: %g prints numbers just below it as that
  // power (0.9999997 as 1), and entries of a rotation are never above 1.
  return {count, integer == 1 && count == 1 ? 0.05 * unit : 0.5 * unit};
}

double typed_error(double value) {
  constexpr int kLeast = 6, kMost = 10;
  // Scaling costs some units in the 16th digit, 1e-6 here; one computed number in 50,000 looks
  // typed, with an error that does not matter.
  constexpr double kScalingNoise = 1e-5;
  double size = std::abs(value);
  if (size == 0) return 0;
  const int exponent = decimal_exponent(size);
  size *= power_of_ten(kMost - 1 - exponent);
  int64_t integer = nearest_integer(size);
  if (std::abs(size - static_cast<double>(integer)) > kScalingNoise) return 0;
  int digits = kMost;
  for (; digits >= kLeast && integer % 10 == 0; --digits) integer /= 10;
  return digits < kLeast ? 0 : 0.5 * power_of_ten(exponent + 1 - digits);
}

Mat3 euler_rotation(const Vec3& angles_deg) {
  const double sx = language::sine_of_degrees(angles_deg.x),
               cx = language::cosine_of_degrees(angles_deg.x);
  const double sy = language::sine_of_degrees(angles_deg.y),
               cy = language::cosine_of_degrees(angles_deg.y);
  const double sz = language::sine_of_degrees(angles_deg.z),
               cz = language::cosine_of_degrees(angles_deg.z);
  return Mat3(Vec3(cy * cz, cy * sz, -sy),
              Vec3(cz * sx * sy - cx * sz, cx * cz + sx * sy * sz, cy * sx),
              Vec3(cx * cz * sy + sx * sz, cx * sy * sz - cz * sx, cx * cy));
}

HealedMatrix heal_matrix(const Affine& from_file) {
  HealedMatrix matrix;
  matrix.map = from_file;
  if (from_file.linear != Mat3(1.0)) {
    heal_linear(matrix, rounding_to_six_digits(from_file.linear));
  }
  bound_translation(matrix);
  return matrix;
}

HealedMatrix heal_typed_matrix(const Affine& from_design) {
  HealedMatrix matrix;
  matrix.map = from_design;
  if (from_design.linear != Mat3(1.0)) {
    Mat3 error;
    for_each_entry([&](int c, int r) { error[c][r] = typed_error(from_design.linear[c][r]); });
    if (largest_entry(error) > 0) heal_linear(matrix, {error, error});
  }
  for (int i = 0; i < 3; ++i) {
    matrix.translation_error[i] = typed_error(from_design.translation[i]);
    matrix.exact = matrix.exact && matrix.translation_error[i] == 0;
  }
  return matrix;
}

}  // namespace frontend
