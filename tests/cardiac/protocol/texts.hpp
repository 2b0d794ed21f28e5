#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/core/error.hpp>

/// The smallest valid protocol: a passive inflation.
inline const std::string kPassive =
    "[mesh]\nshape = \"human_lv\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 7.5\n";

/// The smallest beating one.
inline const std::string kBeat =
    "[mesh]\nshape = \"human_lv\"\n[fibres]\n[activation]\n[contraction]\n[circulation]\n";

inline cardiac::Protocol parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return cardiac::parse_protocol(text, "folder/heart.toml", overrides);
}

/// The message with which the input is refused; empty, with a failure, when it is accepted.
inline std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parsed(text, overrides);
  } catch (const polyaffine::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return "";
}
