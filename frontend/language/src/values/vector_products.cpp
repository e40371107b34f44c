// Products of two vectors, vectors of vectors among them (LANGUAGE.md, "Values").
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "base/evaluation_thread.hpp"
#include "language/make.hpp"
#include "values/operators.hpp"

namespace language {
namespace {

using Row = std::span<const Value>;

Value fail(OperatorProblem& problem, std::string text) {
  problem.text = std::move(text);
  return Value::undef();
}

std::string lengths(size_t left, size_t right) {
  return " (" + std::to_string(left) + " != " + std::to_string(right) + ")";
}

std::string not_rectangular(size_t row) {
  return "Matrix must be rectangular. Problem at row " + std::to_string(row);
}

std::string no_number_in_matrix(size_t row, size_t column) {
  return "Matrix must contain only numbers. Problem at row " + std::to_string(row) + ", col " +
         std::to_string(column);
}

std::string no_number_in_vector(size_t index) {
  return "Vector must contain only numbers. Problem at index " + std::to_string(index);
}

// Returns the elements of a matrix's row; none of what is no vector.
Row row_of(const Value& value) { return value.is_vector() ? value.elements() : Row{}; }

bool is_row(const Value& value, size_t size) {
  return value.is_vector() && value.elements().size() == size;
}

bool is_row_of_numbers(const Value& value, size_t size) {
  return is_row(value, size) && value.holds_numbers();
}

bool is_matrix_of_numbers(Row rows, size_t columns) {
  return std::all_of(rows.begin(), rows.end(),
                     [&](const Value& row) { return is_row_of_numbers(row, columns); });
}

// The product of two vectors of numbers, the right one at least as long.
double product_of_numbers(Row left, Row right) {
  double sum = 0;
  for (size_t i = 0; i < left.size(); ++i) sum += left[i].number() * right[i].number();
  return sum;
}

Value dot_product(const Value& left_vector, const Value& right_vector, OperatorProblem& problem) {
  const Row left = left_vector.elements(), right = right_vector.elements();
  if (left.size() != right.size())
    return fail(problem,
                "vector*vector requires matching lengths" + lengths(left.size(), right.size()));
  if (left_vector.holds_numbers() && right_vector.holds_numbers())
    return product_of_numbers(left, right);
  double sum = 0;
  for (size_t i = 0; i < left.size(); ++i) {
    if (!are_numbers(left[i], right[i]))
      return fail(problem, undefined_operation(left[i], "*", right[i]));
    sum += left[i].number() * right[i].number();
  }
  return sum;
}

// Says what keeps a matrix, which should have columns, and a vector from being numbers in rows.
Value fail_with_vector(Row matrix, Row vector, OperatorProblem& problem) {
  for (size_t i = 0; i < matrix.size(); ++i) {
    count_work(vector.size());
    if (!is_row(matrix[i], vector.size())) return fail(problem, not_rectangular(i));
    const Row row = matrix[i].elements();
    for (size_t j = 0; j < vector.size(); ++j) {
      if (!row[j].is_number()) return fail(problem, no_number_in_matrix(i, j));
      if (!vector[j].is_number()) return fail(problem, no_number_in_vector(j));
    }
  }
  return Value::undef();
}

Value matrix_times_vector(Row matrix, const Value& right_vector, OperatorProblem& problem) {
  const Row vector = right_vector.elements();
  const size_t columns = matrix.front().elements().size();
  if (columns != vector.size())
    return fail(problem, "matrix*vector requires matrix column count to match vector length" +
                             lengths(columns, vector.size()));
  if (!right_vector.holds_numbers() || !is_matrix_of_numbers(matrix, columns))
    return fail_with_vector(matrix, vector, problem);
  count_work(matrix.size() * columns);
  NumberWriter result(matrix.size());
  for (const Value& row : matrix) result.put(product_of_numbers(row.elements(), vector));
  return result.take();
}

// OpenSCAD says what is wrong with the elements twice, at first without a place.
Value fail_twice(OperatorProblem& problem, std::string text) {
  problem.unplaced = text;
  return fail(problem, std::move(text));
}

// Puts the products of a vector and so many columns of a matrix.
template <size_t kColumns>
void put_products(Row vector, Row matrix, size_t first_column, NumberWriter& result) {
  std::array<double, kColumns> sums{};
  for (size_t j = 0; j < vector.size(); ++j) {
    const double factor = vector[j].number();
    const Value* const row = matrix[j].elements().data() + first_column;
    for (size_t i = 0; i < kColumns; ++i) sums[i] += factor * row[i].number();
  }
  for (const double sum : sums) result.put(sum);
}

// The product of a vector of numbers and a matrix of numbers.
Value numbers_times_matrix(Row vector, Row matrix, size_t columns) {
  count_work(vector.size() * columns);
  NumberWriter result(columns);
  size_t done = 0;
  for (; columns - done >= 4; done += 4) put_products<4>(vector, matrix, done, result);
  if (columns - done == 3) put_products<3>(vector, matrix, done, result);
  if (columns - done == 2) put_products<2>(vector, matrix, done, result);
  if (columns - done == 1) put_products<1>(vector, matrix, done, result);
  return result.take();
}

// Says what keeps a vector and a matrix, which has columns, from being numbers in rows.
Value fail_with_matrix(Row vector, Row matrix, size_t columns, OperatorProblem& problem) {
  for (size_t i = 0; i < columns; ++i) {
    for (size_t j = 0; j < vector.size(); ++j) {
      if (!is_row(matrix[j], columns)) return fail_twice(problem, not_rectangular(j));
      if (!vector[j].is_number()) return fail_twice(problem, no_number_in_vector(j));
      if (!matrix[j].elements()[i].is_number())
        return fail_twice(problem, no_number_in_matrix(j, i));
    }
  }
  return Value::undef();
}

Value vector_times_matrix(const Value& left_vector, Row matrix, OperatorProblem& problem) {
  const Row vector = left_vector.elements();
  if (vector.size() != matrix.size())
    return fail(problem, "vector*matrix requires vector length to match matrix row count" +
                             lengths(vector.size(), matrix.size()));
  const size_t columns = matrix.front().elements().size();
  if (columns == 0) return make_vector();
  if (!left_vector.holds_numbers() || !is_matrix_of_numbers(matrix, columns))
    return fail_with_matrix(vector, matrix, columns, problem);
  return numbers_times_matrix(vector, matrix, columns);
}

Value matrix_times_matrix(Row left, Row right, OperatorProblem& problem) {
  const size_t columns = left.front().elements().size();
  if (columns != right.size())
    return fail(
        problem,
        "matrix*matrix requires left operand column count to match right operand row count" +
            lengths(columns, right.size()));
  const size_t right_columns = right.front().elements().size();
  const bool is_plain = is_matrix_of_numbers(right, right_columns);
  Value result = make_vector(left.size());
  for (size_t i = 0; i < left.size(); ++i) {
    const Row row = row_of(left[i]);
    if (row.size() != right.size())
      return fail(problem,
                  "matrix*matrix left operand row length does not match right operand row count" +
                      lengths(row.size(), right.size()) + " at row " + std::to_string(i));
    Value product = is_plain && left[i].holds_numbers()
                        ? numbers_times_matrix(row, right, right_columns)
                        : vector_times_matrix(left[i], right, problem);
    if (product.is_undef()) {
      problem.text += "\n\twhile processing left operand at row " + std::to_string(i);
      return product;
    }
    append_in_room(result, std::move(product));
  }
  return result;
}

}  // namespace

Value operators::multiply_vectors(const Value& left_vector, const Value& right_vector,
                                  OperatorProblem& problem) {
  const Row left = left_vector.elements(), right = right_vector.elements();
  if (left.empty() || right.empty())
    return fail(problem, "Multiplication is undefined on empty vectors");
  const Value &left_first = left.front(), &right_first = right.front();
  if (are_numbers(left_first, right_first)) return dot_product(left_vector, right_vector, problem);
  if (left_first.is_number() && right_first.is_vector())
    return vector_times_matrix(left_vector, right, problem);
  if (left_first.is_vector() && right_first.is_number())
    return matrix_times_vector(left, right_vector, problem);
  if (left_first.is_vector() && right_first.is_vector())
    return matrix_times_matrix(left, right, problem);
  std::string text = "undefined vector*vector multiplication where first elements are types ";
  text += type_name(left_first.type());
  text += " and ";
  text += type_name(right_first.type());
  return fail(problem, std::move(text));
}

}  // namespace language
