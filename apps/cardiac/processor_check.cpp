// Compiled for every x86-64 processor and without any inline function of the library, so that it runs where
// the rest of the program cannot.
#ifdef CARDIAC_X86_64_V3
#include <unistd.h>

namespace {

/// Runs before the other initialisers of the program, the first place where an illegal instruction could be.
[[gnu::constructor(101)]] void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return;
  constexpr char message[] =
      "cardiac: error: this program was compiled for x86-64-v3, and the processor lacks AVX2 or FMA; build "
      "it "
      "with -DCARDIAC_X86_64_V3=OFF\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof(message) - 1);
  _exit(1);
}

}  // namespace
#endif
