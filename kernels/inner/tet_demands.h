// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is asked of tets beside their shape.
#pragma once

#include "kernels/inner/inner_demand.h"
#include "kernels/size/size_field.h"

namespace mw {

struct TetDemands {
  const SizeField* sizes = nullptr;    ///< edges keep to these limits; null: none
  const InnerDemand* inner = nullptr;  ///< inner vertices that tets keep; null: none
};

}  // namespace mw
