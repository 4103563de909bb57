/// Debian's OpenBLAS does not know processors younger than itself and falls back to kernels for SSE3, which
/// makes a factorisation 1.4 times as long. It can be told better, but only by its environment and before it
/// is loaded.
#pragma once

namespace fpi::fluid {

/// Starts this program anew with OPENBLAS_CORETYPE set, where OpenBLAS took its oldest kernels on a processor
/// with AVX2. Returns where nothing is to be done: another BLAS, a choice of the user's, or kernels that fit.
void choose_blas_kernel(char** argv);

}  // namespace fpi::fluid
