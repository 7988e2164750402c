// One small table of a scene's file for each effect, by its name in the table of scene_effects.hpp.
#pragma once

#include <array>
#include <string_view>

namespace bench {

struct EffectTable {
  std::string_view name;
  std::string_view toml;
};

inline constexpr std::array effect_tables = {
    EffectTable{"viscoelasticity", "[viscoelasticity]\nterms = [{ fraction = 0.3, time = 1 }]\n"},
    EffectTable{"hysteresis", "[hysteresis]\nthresholds = [0.01]\nweights = [0.1]\n"},
    EffectTable{"crosstalk", "[crosstalk]\nfraction = 0.1\n"},
    EffectTable{"gain_error", "[gain_error]\nrms = 0.1\n"},
    EffectTable{"offset_error", "[offset_error]\nrms = 0.1\n"},
    EffectTable{"temperature", "[temperature]\nchange = 1\ngain = 0.1\n"},
    EffectTable{"low_pass", "[low_pass]\ncutoff = 10\n"},
    EffectTable{"sampling", "[sampling]\naperture = 0.01\n"},
    EffectTable{"noise", "[noise]\nrms = 0.1\n"},
    EffectTable{"taxel_noise", "[taxel_noise]\nindices = [3]\nrms = [0.1]\n"},
    EffectTable{"saturation", "[saturation]\nrange = [-0.1, 0.1]\n"},
    EffectTable{"quantization", "[quantization]\nbits = 12\nrange = [-1, 1]\n"},
    EffectTable{"stuck_taxels", "[stuck_taxels]\nindices = [3]\nvalues = [0.1]\n"},
    EffectTable{"dead_taxels", "[dead_taxels]\nindices = [3]\n"},
};

/// Empty where there is none.
[[nodiscard]] constexpr std::string_view effect_table(std::string_view name) noexcept {
  for (const EffectTable& table : effect_tables)
    if (table.name == name) return table.toml;
  return {};
}

}  // namespace bench
