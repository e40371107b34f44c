// The protocol's forms of places and texts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "features.hpp"
#include "rpc.hpp"
#include "workspace.hpp"

namespace serve {

/// Returns the error of parameters.
RequestError invalid(const std::string& what);

/// Returns the path of a `file:` URI; "-" of any other.
std::string path_of_uri(std::string_view uri);
std::string uri_of_path(std::string_view path);
/// Returns the key of a document: TextOverlay's of its file, or the URI itself.
std::string key_of_uri(const std::string& uri);

Json json_of(Range range);
/// Both throw RequestError if the JSON is no such thing.
Position position_of(const Json& json);
Range range_of(const Json& json);
/// Returns a whole number that is not negative. Throws RequestError.
uint32_t number_of(const Json& json);
/// Returns a member that must be there. Throws RequestError.
const Json& member_of(const Json& json, const char* name);
std::string text_of(const Json& json, const char* name);
/// Returns a member further in, or null where there is none.
const Json& find_member(const Json& json, std::initializer_list<const char*> path);

/// Returns a text after the changes of a `didChange`. Throws RequestError.
TextPointer changed_text(TextPointer text, const Json& changes, PositionEncoding encoding);

int completion_kind(ItemKind kind);
int symbol_kind(ItemKind kind);
Json markup(const std::string& code, const std::string& about);
Json json_of(const Symbol& symbol, const Text& text, PositionEncoding encoding);
Json json_of(const Said& said, PositionEncoding encoding);

}  // namespace serve
