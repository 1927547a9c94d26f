// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

namespace mw::cli {

void start_log(const std::string& level) {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("mwmesh", std::move(sink)));
  spdlog::set_pattern("mwmesh: %l: %v");
  spdlog::set_level(spdlog::level::from_str(level));
}

void log_info(const std::string& line) {
  spdlog::info(line);
}

void log_warning(const std::string& line) {
  spdlog::warn(line);
}

}  // namespace mw::cli
