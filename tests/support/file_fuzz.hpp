#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/times.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <polyaffine/core/error.hpp>
#include <string>
#include <vector>

#include "support/mutation.hpp"
#include "support/whole_file.hpp"

/// Processor time of this process and its ended children; other work on the machine does not count.
inline double processor_seconds_with_children() {
  tms spent{};
  times(&spent);
  return static_cast<double>(spent.tms_utime + spent.tms_stime + spent.tms_cutime + spent.tms_cstime) /
         static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// The most memory that this process, or one of its ended children, has held.
inline double peak_memory_MB() {
  rusage own{}, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  return static_cast<double>(std::max(own.ru_maxrss, children.ru_maxrss)) / 1024;
}

/// Changes a file at random, `inputs` times from its first state, and lets `read` try each: it must accept it
/// or throw an InputError that names the file (or holds `named`), within 5 s of processor time and without
/// taking a gigabyte (address sanitizers keep a quarter of one). Some must be accepted, but not all.
inline void expect_read_or_refused(const std::filesystem::path& file, const std::vector<std::string>& words,
                                   int inputs, const std::function<void()>& read,
                                   const std::string& named = "") {
  Mutator mutator({whole_file(file)}, words, 1);
  const std::string name = named.empty() ? file.stem().string() + "." : named;
  int accepted = 0;
  double longest_s = 0;
  const double memory_MB = peak_memory_MB();
  for (int k = 0; k < inputs; ++k) {
    const std::string bytes = mutator.next();
    std::filesystem::remove(file);  // writing over a file waits for the disk
    std::ofstream(file, std::ios::binary) << bytes;
    const double begin = processor_seconds_with_children();
    try {
      read();
      ++accepted;
    } catch (const polyaffine::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      FAIL() << "input " << k << ": " << error.what() << "\n" << bytes;
    }
    longest_s = std::max(longest_s, processor_seconds_with_children() - begin);
  }
  EXPECT_GT(accepted, inputs / 100) << "the inputs are so wrong that little is tried";
  EXPECT_LT(accepted, inputs) << "the inputs are not wrong";
  EXPECT_LT(longest_s, 5);
  EXPECT_LT(peak_memory_MB() - memory_MB, 1000);
}
