// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Texts for each entry of the table of settings, made of what the entry says of its values.
#pragma once

#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Texts of a setting: other values than the default, values out of range, no values.
struct Samples {
  std::vector<std::string> good;
  std::vector<std::string> outside;
  std::vector<std::string> bad;
};

inline const Samples kSizeSamples{
    {"3=0.1", "3=0.2", "1=2.5,7=4", "18446744073709551615=3", "*=2.5", "*=5", "3=2,3|5=1,*=5",
     "*|*=2,*|3=1,3|5=4,*=5", "*|*=4.2vox", "3=2vox,*=5vox", "3=2vox,@f.npy", "@f.nii.gz", "@f.npy",
     "*=4,@d/f.mha"},
    {},
    {"x",           "3:1",        "3=",      "=3",   "3=0",     "3=-1",        "3=inf",      "3=1,",
     "3=1,3=1",     "x=1",        "3|3=1",   "3|=1", "1|2|3=1", "1|2=3,2|1=4", "3,*=4",      "3,4",
     "f.npy,g.npy", "3=1vox,*=5", "*|*|3=1", "vox",  "3=vox",   "*|*=1,*|*=2", "3|*=1,*|3=2"}};

/// The ends of the range, what is beside them, and numbers that are written in other ways.
inline Samples samples_of_integers(const Setting& setting) {
  const auto at = [&](double from, int steps) {
    return std::to_string(static_cast<std::int64_t>(from) + steps);
  };
  Samples out{{at(setting.least, setting.step), at(setting.least, 0), at(setting.most, 0)},
              {at(setting.least, -setting.step), at(setting.most, setting.step), "-4294967297",
               "4000000000001"},
              {"4e1", "4.0", "two", ""}};
  if (setting.step > 1) out.outside.push_back(at(setting.least, 1));
  return out;
}

inline Samples samples_of_numbers(const Setting& setting) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Samples out{{format_number(setting.least / 2 + setting.most / 2), format_number(setting.least),
               format_number(setting.most)},
              {},
              {"nan", "inf", "Auto", "None", "1,5", "1.5 ", "half", ""}};
  for (const double beyond :
       {std::nextafter(setting.least, -kInfinity), std::nextafter(setting.most, kInfinity)}) {
    if (std::isfinite(beyond)) out.outside.push_back(format_number(beyond));
  }
  const bool is_none = setting.kind == ValueKind::kNumberOrNone;
  const bool is_auto = setting.kind == ValueKind::kNumberOrAuto;
  (is_none ? out.good : out.bad).emplace_back("none");
  (is_auto ? out.good : out.bad).emplace_back("auto");
  return out;
}

/// Each choice, and each in other letters.
inline Samples samples_of_choices(const Setting& setting) {
  Samples out{setting.choices, {}, {""}};
  for (const std::string& choice : setting.choices) {
    for (const std::string& text : {choice + "x", choice + " ", "X" + choice.substr(1)}) {
      out.bad.push_back(text);
    }
  }
  return out;
}

inline Samples samples(const Setting& setting) {
  if (setting.has_labels) return kSizeSamples;
  Samples out = setting.kind == ValueKind::kSwitch    ? Samples{{"true", "false"}, {}, {"yes", ""}}
                : setting.kind == ValueKind::kInteger ? samples_of_integers(setting)
                : setting.kind == ValueKind::kText    ? samples_of_choices(setting)
                                                      : samples_of_numbers(setting);
  std::erase(out.good, setting.text(MeshSettings{}));
  return out;
}

}  // namespace mw::engine::test
