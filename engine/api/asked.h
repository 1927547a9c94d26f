// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller's options ask for, in the terms of the engine.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "engine/mwmesh_c.h"
#include "engine/request/mesh_request.h"
#include "engine/request/option_set.h"

namespace mw::api {

/// The options of a call, as the program has those of a command.
class Asked {
 public:
  /// Nothing is given.
  Asked();
  /// options may be null: none are given.  ERRORS: mw::Error(kUsage) naming an option.
  explicit Asked(const mw_options* options);
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  [[nodiscard]] request::MeshRequest& request() { return request_; }
  [[nodiscard]] request::OptionSet& options() { return options_; }

 private:
  request::MeshRequest request_;
  request::OptionSet options_;
};

/// Returns the name of an option as the command line has it, "max-distance".
[[nodiscard]] std::string flag_of(std::string name);

/// Returns the message in words for a caller of functions: "--max-distance" becomes "max_distance".
/// Flags that are no option of the library stay as they are: they belong to commands.
[[nodiscard]] std::string in_words(const std::string& message);

/// Returns the name of the option that a message is about, which begins with its flag, as "--crop:
/// " and "--scale 7: " do; empty if it is about none.
[[nodiscard]] std::string option_of(const std::string& message);

}  // namespace mw::api

struct mw_options {
  std::map<std::string, std::string> given;         ///< by the name of the command line's flag
  mutable std::mutex mutex;                         ///< of the two below
  mutable mw::api::Asked table;                     ///< checks values, and finds effective ones
  mutable std::map<std::string, std::string> told;  ///< what mw_options_get() returned
};
