// The builtin functions that stand in the table of builtin_functions.cpp.
#pragma once

#include "functions/function_call.hpp"

namespace language::functions {

// numbers.cpp
Value absolute(const FunctionCall& call);
Value sign(const FunctionCall& call);
Value floor(const FunctionCall& call);
Value ceiling(const FunctionCall& call);
Value round(const FunctionCall& call);
Value square_root(const FunctionCall& call);
Value exponential(const FunctionCall& call);
Value natural_logarithm(const FunctionCall& call);
Value sine(const FunctionCall& call);
Value cosine(const FunctionCall& call);
Value tangent(const FunctionCall& call);
Value arc_sine(const FunctionCall& call);
Value arc_cosine(const FunctionCall& call);
Value arc_tangent(const FunctionCall& call);
Value arc_tangent_of_two(const FunctionCall& call);
Value power(const FunctionCall& call);
Value logarithm(const FunctionCall& call);
Value minimum(const FunctionCall& call);
Value maximum(const FunctionCall& call);

// vectors.cpp
Value norm(const FunctionCall& call);
Value cross(const FunctionCall& call);
Value length(const FunctionCall& call);
Value concatenation(const FunctionCall& call);

// texts.cpp
Value string(const FunctionCall& call);
Value characters(const FunctionCall& call);
Value code_point(const FunctionCall& call);

// lookup.cpp, search.cpp, rands.cpp
Value lookup(const FunctionCall& call);
Value search(const FunctionCall& call);
Value random_numbers(const FunctionCall& call);

// drawings.cpp
Value drawing_dimension(const FunctionCall& call);
Value drawing_cross(const FunctionCall& call);

// facts.cpp
Value version(const FunctionCall& call);
Value version_number(const FunctionCall& call);
Value is_list(const FunctionCall& call);
Value is_number(const FunctionCall& call);
Value is_bool(const FunctionCall& call);
Value is_string(const FunctionCall& call);
Value is_function(const FunctionCall& call);
Value parent_module(const FunctionCall& call);

/// The rules by which arguments are evaluated: until one is no number; none; the first alone; the
/// first four; all if there are as many as the function takes, else none; lookup()'s key, which is
/// evaluated twice if it is no finite number, and then its table if it is.
size_t next_while_numbers(const FunctionCall& call);
size_t next_of_none(const FunctionCall& call);
size_t next_of_one(const FunctionCall& call);
size_t next_of_four(const FunctionCall& call);
size_t next_of_exactly_one(const FunctionCall& call);
size_t next_of_exactly_two(const FunctionCall& call);
size_t next_of_lookup(const FunctionCall& call);

/// The same of chr(), rands(), dxf_dim() and dxf_cross(), which warn of an argument before the next
/// one is evaluated.
size_t next_of_characters(const FunctionCall& call);
size_t next_of_random_numbers(const FunctionCall& call);
size_t next_of_drawing(const FunctionCall& call);

/// Warns that an argument has the wrong type, and returns undef.
Value not_converted(const FunctionCall& call);

}  // namespace language::functions
