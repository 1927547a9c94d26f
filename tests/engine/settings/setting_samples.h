// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Texts for each entry of the table of settings.
#pragma once

#include "engine/settings/setting_table.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Texts of a setting: other values than the default, values out of range, no values.
struct Samples {
  std::vector<std::string> good;
  std::vector<std::string> outside;
  std::vector<std::string> bad;
};

inline const std::map<std::string, Samples> kSettingSamples{
    {"window", {{"4", "40", "256"}, {"-4", "2", "33", "258", "99999999999"}, {"4e1", "4.0", ""}}},
    {"marches", {{"1", "4"}, {"0", "5", "-1", "4294967297"}, {"two"}}},
    {"order", {{"raster"}, {}, {"color", "Raster", ""}}},
    {"edge-variance", {{"0.1", "1e-300", "5"}, {"0", "-0.1"}, {"nan", "inf", "None", "1,5"}}},
    {"quality-floor", {{"0", "0.1", "0.5"}, {"-0.1", "0.51"}, {"none", "nan"}}},
    {"inner-quality", {{"0", "0.3", "0.8"}, {"-0.1", "0.81"}, {"none", "nan", "Auto"}}},
    {"max-distance", {{"none", "0.75", "16"}, {"0.7", "16.01", "-1", "0"}, {"inf", "1.5 "}}},
    {"target-reduction", {{"0.5", "0.001"}, {"0", "1", "-0.5"}, {"half"}}},
    {"topology", {{"interfaces"}, {}, {"label"}}},
    {"surface", {{"voxel"}, {}, {"rough"}}},
    {"periodic", {{"x", "yz", "xyz"}, {}, {"zx", "x,y", ""}}},
    {"optimizer", {{"tetgen", "none"}, {}, {"odt"}}},
    {"odt-iterations", {{"1", "1000"}, {"0", "1001"}, {"1.5"}}},
    {"start", {{"octree", "dense"}, {}, {"fine"}}},
    {"size",
     {{"3=0.1", "3=0.2", "1=2.5,7=4", "18446744073709551615=3", "*=2.5", "*=5", "3=2,3|5=1,*=5",
       "*|*=2,*|3=1,3|5=4,*=5", "*|*=4.2vox", "3=2vox,*=5vox", "3=2vox,@f.npy", "@f.nii.gz",
       "@f.npy", "*=4,@d/f.mha"},
      {},
      {"x",       "3:1",         "3=",      "=3",          "3=0",         "3=-1",
       "3=inf",   "3=1,",        "3=1,3=1", "x=1",         "3|3=1",       "3|=1",
       "1|2|3=1", "1|2=3,2|1=4", "3,*=4",   "3,4",         "f.npy,g.npy", "3=1vox,*=5",
       "*|*|3=1", "vox",         "3=vox",   "*|*=1,*|*=2", "3|*=1,*|3=2"}}},
    {"gradation", {{"0", "0.5", "10"}, {"-0.1", "10.5"}, {"some"}}},
    {"inner-vertices", {{"true"}, {}, {"yes", ""}}},
    {"count", {{"1", "100000", "1000000000000"}, {"-1", "1000000000001"}, {"1e5", "many", "1.5"}}},
    {"across", {{"1", "16"}, {"-1", "17"}, {"two", "1.5"}}},
};

inline const Samples& samples(const Setting& setting) {
  return kSettingSamples.at(setting.name);  // throws for a setting that has none: write some
}

}  // namespace mw::engine::test
