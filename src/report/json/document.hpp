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
inline constexpr DocumentKind run{"run", 2};
inline constexpr DocumentKind explain{"explain"};  ///< run --explain
inline constexpr DocumentKind relax{"relax"};
inline constexpr DocumentKind deck{"deck"};              ///< relax FILE.cir
inline constexpr DocumentKind macromodel{"macromodel"};  ///< relax SCENE --model FILE
inline constexpr DocumentKind refinement{"refinement"};  ///< relax SCENE --refine KEYS
inline constexpr DocumentKind bench{"bench"};
inline constexpr DocumentKind certify{"certify"};
inline constexpr DocumentKind datasheet{"datasheet"};  ///< certify --datasheet
inline constexpr DocumentKind simulate{"simulate"};
inline constexpr DocumentKind solve{"solve", 2};
inline constexpr DocumentKind identify{"identify", 2};
inline constexpr DocumentKind check{"check"};
inline constexpr DocumentKind report{"report"};
inline constexpr DocumentKind calibrate{"calibrate"};
inline constexpr DocumentKind plan{"plan"};
inline constexpr DocumentKind tradeoff{"tradeoff"};
inline constexpr DocumentKind sweep{"sweep"};  ///< merge too
inline constexpr DocumentKind grasp{"grasp", 2};
}  // namespace kind

/// {"tactile_net": version, "kind": ..., "schema": ...}
[[nodiscard]] Json document(const DocumentKind& kind);

}  // namespace tactile_net::report
