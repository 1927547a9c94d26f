// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which label each speck takes.
#pragma once

#include <optional>

#include "io/labels/speck_contacts.h"

namespace mw::io {

/// What the rounds came to.
struct SpeckOutcome {
  std::vector<std::optional<RawLabel>> becomes;  ///< by speck; none: it stays
  int rounds = 0;                                ///< in which some speck changed
};

/// In a round all components that are too small are specks.  Each takes the label that most faces
/// of its voxels to voxels in no speck have, the smaller label of two with as many; one without
/// such faces waits for the next round, in which neighbours that have changed are specks no more:
/// nor is one that touches such a neighbour of its own label by then.  Until nothing changes.
/// The volume is not needed: a speck that changes becomes part of a component that is none, so
/// specks never grow, shrink or merge with each other.
/// labels: by speck.  Cost: O(contacts log contacts) whatever the number of rounds.
[[nodiscard]] SpeckOutcome settle_specks(const std::vector<RawLabel>& labels,
                                         const SpeckContacts& contacts, bool labels_signed);

}  // namespace mw::io
