// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of a mesh in memory, and how reports say it.
#include "engine/report/mesh_facts.h"

#include <iostream>

#include "engine/report/figures.h"

namespace mw::report {

using io::Json;

Json quality_json(const audit::QualityReport& quality) {
  return {{"radius_ratio_min", quality.radius_ratio_min},
          {"radius_ratio_mean", quality.radius_ratio_mean},
          {"radius_ratio_histogram", quality.radius_ratio_histogram},
          {"dihedral_histogram", quality.dihedral_histogram},
          {"sliver_fraction", quality.sliver_fraction},
          {"dihedral_min_deg", quality.dihedral_min_deg},
          {"dihedral_max_deg", quality.dihedral_max_deg}};
}

void print_quality(const audit::QualityReport& quality) {
  std::cout << "radius ratio  " << format_fixed(quality.radius_ratio_min, 4) << " least, "
            << format_fixed(quality.radius_ratio_mean, 4) << " mean, "
            << format_fixed(100 * quality.sliver_fraction, 3) << " % of tets below 0.1\n"
            << "dihedral      " << format_fixed(quality.dihedral_min_deg, 2) << " to "
            << format_fixed(quality.dihedral_max_deg, 2) << " degrees\n";
}

Json label_json(RawLabel label, bool is_signed) {
  if (is_signed) return static_cast<std::int64_t>(label);
  return label;
}

void write_json(io::AtomicFile& file, const Json& value) {
  file.append(value.dump_indented());
  file.append("\n");
  file.commit();
}

}  // namespace mw::report
