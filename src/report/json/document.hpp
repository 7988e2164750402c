/// @file
/// How every JSON document begins. Private.
#pragma once

#include <string_view>

#include "report/json/values.hpp"

namespace tactile_net::report {

/// What a document is. `schema` grows by one when a key goes, or means something else: whoever
/// reads one asks for both. schema.hpp has the JSON Schema.
struct DocumentKind {
  std::string_view name;
  int schema = 1;
};

namespace kind {
inline constexpr DocumentKind run{"run"};
inline constexpr DocumentKind skin_run{"skin_run"};      ///< run, of a skin
inline constexpr DocumentKind skin_solve{"skin_solve"};  ///< solve, of a skin
inline constexpr DocumentKind explain{"explain"};        ///< run --explain
inline constexpr DocumentKind relax{"relax"};
inline constexpr DocumentKind deck{"deck"};  ///< relax FILE.cir
inline constexpr DocumentKind certify{"certify"};
inline constexpr DocumentKind simulate{"simulate"};
inline constexpr DocumentKind solve{"solve"};
inline constexpr DocumentKind identify{"identify"};
inline constexpr DocumentKind skin_identify{"skin_identify"};  ///< identify, of a skin
inline constexpr DocumentKind check{"check"};
inline constexpr DocumentKind calibrate{"calibrate"};
inline constexpr DocumentKind plan{"plan"};
inline constexpr DocumentKind tradeoff{"tradeoff"};
inline constexpr DocumentKind sweep{"sweep"};  ///< merge too
inline constexpr DocumentKind grasp{"grasp"};
inline constexpr DocumentKind space_grasp{"space_grasp"};  ///< grasp, of a hand in space
}  // namespace kind

/// {"tactile_net": version, "kind": ..., "schema": ...}
[[nodiscard]] Json document(const DocumentKind& kind);

}  // namespace tactile_net::report
