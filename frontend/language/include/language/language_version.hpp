// The versions of OpenSCAD's language that are evaluated, and tables of what differs.
#pragma once

#include <cstdint>

namespace language {

enum class LanguageVersion : uint8_t {
  k2021,  // 2021.01, the last release
  k2026,  // the development snapshots
};

/// The base of a table of what differs between versions, whose members are its rows: the behaviour
/// of 2021.01 stands beside that of 2026.
class VersionTable {
 public:
  explicit constexpr VersionTable(LanguageVersion of) : version(of) {}

  const LanguageVersion version;

 protected:
  template <typename Behaviour>
  constexpr Behaviour row(Behaviour of_2021, Behaviour of_2026) const {
    return version == LanguageVersion::k2021 ? of_2021 : of_2026;
  }
};

}  // namespace language
