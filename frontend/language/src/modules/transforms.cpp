// translate, rotate, scale, mirror, multmatrix: all make multmatrix nodes.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "language/degrees.hpp"
#include "language/make.hpp"
#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

using Vec3 = std::array<double, 3>;
using Matrix = std::array<std::array<double, 4>, 4>;  // by rows

constexpr Matrix kIdentity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

Made finish(const BuiltinCall& call, NodeTree& tree, const Matrix& matrix) {
  set_kind(tree, NodeKind::kMultmatrix);
  add_numbers(tree, "", {matrix.front().data(), 16},
              call.environment.dialect.writes_general_numbers ? ArgumentStyle::kGeneralMatrix
                                                              : ArgumentStyle::kMatrix);
  return Made::kNode;
}

bool are_finite(const Vec3& vector) {
  return std::all_of(vector.begin(), vector.end(), [](double x) { return std::isfinite(x); });
}

/// The rotation about x, then y, then z, by degrees.
Matrix rotation(const Vec3& angles_deg) {
  const double sx = sine_of_degrees(angles_deg[0]), cx = cosine_of_degrees(angles_deg[0]);
  const double sy = sine_of_degrees(angles_deg[1]), cy = cosine_of_degrees(angles_deg[1]);
  const double sz = sine_of_degrees(angles_deg[2]), cz = cosine_of_degrees(angles_deg[2]);
  return {{{cy * cz, cz * sx * sy - cx * sz, cx * cz * sy + sx * sz, 0},
           {cy * sz, cx * cz + sx * sy * sz, -cz * sx + cx * sy * sz, 0},
           {-sy, cy * sx, cx * cy, 0},
           {0, 0, 0, 1}}};
}

/// The rotation about an axis, by Rodrigues' formula; the identity if the axis has no length.
Matrix rotation_about(double angle_deg, const Vec3& axis) {
  const double squared = axis[0] * axis[0] + (axis[1] * axis[1] + axis[2] * axis[2]);
  if (!(squared > 0)) return kIdentity;  // also for NaN
  const double sine = sine_of_degrees(angle_deg), cosine = cosine_of_degrees(angle_deg);
  const double turn = (1 - cosine) / squared;
  const double length = std::sqrt(squared);
  Vec3 c, u;
  for (size_t i = 0; i < 3; ++i) {
    c[i] = axis[i] * turn;
    u[i] = axis[i] / length * sine;
  }
  return {{{c[0] * axis[0] + cosine, c[1] * axis[0] - u[2], c[2] * axis[0] + u[1], 0},
           {c[0] * axis[1] + u[2], c[1] * axis[1] + cosine, c[2] * axis[1] - u[0], 0},
           {c[0] * axis[2] - u[1], c[1] * axis[2] + u[0], c[2] * axis[2] + cosine, 0},
           {0, 0, 0, 1}}};
}

/// Returns the identity times a rotation. An entry that is not finite spoils its column, and a -0
/// stays where what it is added to is not positive: a .csg of 2026 shows it.
Matrix times_identity(const Matrix& matrix) {
  Matrix product = kIdentity;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      product[row][column] = kIdentity[row][0] * matrix[0][column] +
                             kIdentity[row][1] * matrix[1][column] +
                             kIdentity[row][2] * matrix[2][column];
    }
  }
  return product;
}

/// Reads rotate([x, y, z]) into `angles_deg`. Returns false where something is wrong. Angles are
/// read from the last to the first; what is no number counts as the angle read before it.
bool read_angles(std::span<const Value> elements, Vec3& angles_deg) {
  bool is_good = elements.size() <= 3;
  double angle = 0;
  for (size_t i = std::min<size_t>(elements.size(), 3); i-- > 0;) {
    is_good = is_finite_number(elements[i]) && is_good;
    angle = number_or(elements[i], angle);
    angles_deg[i] = angle;
  }
  return is_good;
}

Made rotate_by_vector(const BuiltinCall& call, NodeTree& tree) {
  const Value& a = call.parameters[0];
  const Value& v = call.parameters[1];
  Vec3 angles_deg = {0, 0, 0};
  const bool is_good = read_angles(a.elements(), angles_deg);
  const std::string arguments =
      "rotate(a=" + shown(a) + (is_given(v) ? ", v=" + shown(v) : "") + ")";
  if (!is_good) {
    warn(call, "Problem converting " + arguments + " parameter");
  } else if (is_given(v)) {
    warn(call, "When parameter a is supplied as vector, v is ignored " + arguments);
  }
  return finish(call, tree, times_identity(rotation(angles_deg)));
}

}  // namespace

Made make_translate(const BuiltinCall& call, NodeTree& tree) {
  const Value& v = call.parameters[0];
  Vec3 move = {0, 0, 0};
  Matrix matrix = kIdentity;
  if (read_vec3(v, move, 0) && are_finite(move)) {
    for (size_t i = 0; i < 3; ++i) matrix[i][3] += move[i];  // makes 0 of -0
  } else {
    warn(call,
         "Unable to convert translate(" + shown(v) + ") parameter to a vec3 or vec2 of numbers");
  }
  return finish(call, tree, matrix);
}

Made make_scale(const BuiltinCall& call, NodeTree& tree) {
  const Value& v = call.parameters[0];
  Vec3 factors = {1, 1, 1};
  if (v.is_number()) {
    factors.fill(v.number());
  } else if (!read_vec3(v, factors, 1)) {
    warn(call, "Unable to convert scale(" + shown(v) +
                   ") parameter to a number, a vec3 or vec2 of numbers or a number");
  }
  const bool is_flat = std::find(factors.begin(), factors.end(), 0.0) != factors.end();
  if (call.environment.checks_ranges && (is_flat || !are_finite(factors))) {
    warn(call, "scale(" + shown(v) + ")");
  }
  Matrix matrix = kIdentity;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) matrix[row][column] *= factors[column];
  }
  return finish(call, tree, matrix);
}

Made make_rotate(const BuiltinCall& call, NodeTree& tree) {
  const Value& a = call.parameters[0];
  const Value& v = call.parameters[1];
  if (a.is_vector()) return rotate_by_vector(call, tree);
  Vec3 axis = {0, 0, 1};
  const bool is_angle = is_finite_number(a);
  const bool is_axis = !is_given(v) || read_vec3(v, axis, 0);
  if (!is_angle && !is_axis) {
    warn(call, "Problem converting rotate(a=" + shown(a) + ", v=" + shown(v) + ") parameter");
  } else if (!is_angle) {
    warn(call, "Problem converting rotate(a=" + shown(a) + ") parameter");
  } else if (!is_axis) {
    warn(call, "Problem converting rotate(..., v=" + shown(v) + ") parameter");
  }
  return finish(call, tree, times_identity(rotation_about(is_angle ? a.number() : 0, axis)));
}

Made make_mirror(const BuiltinCall& call, NodeTree& tree) {
  const Value& v = call.parameters[0];
  Vec3 n = {1, 0, 0};
  if (!read_vec3(v, n, 0)) {
    warn(call, "Unable to convert mirror(" + shown(v) + ") parameter to a vec3 or vec2 of numbers");
  }
  Matrix matrix = kIdentity;
  if (n[0] != 0 || n[1] != 0 || n[2] != 0) {
    const double squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    for (size_t row = 0; row < 3; ++row) {
      for (size_t column = 0; column < 3; ++column) {
        const double product = 2 * n[column] * n[row] / squared;
        matrix[row][column] = row == column ? 1 - product : -product;
      }
    }
  }
  return finish(call, tree, matrix);
}

Made make_multmatrix(const BuiltinCall& call, NodeTree& tree) {
  const Value& m = call.parameters[0];
  Matrix matrix = kIdentity;
  if (m.is_vector()) {
    const std::span<const Value> rows = m.elements();
    for (size_t i = 0; i < std::min<size_t>(rows.size(), 4); ++i) {
      if (!rows[i].is_vector()) continue;
      const std::span<const Value> row = rows[i].elements();
      for (size_t j = 0; j < std::min<size_t>(row.size(), 4); ++j) {
        matrix[i][j] = number_or(row[j], matrix[i][j]);
      }
    }
    const double divisor = matrix[3][3];
    if (divisor != 1) {
      for (auto& row : matrix) {
        for (double& entry : row) entry /= divisor;
      }
    }
  }
  return finish(call, tree, matrix);
}

}  // namespace language
