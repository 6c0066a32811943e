// Refuses compiler flags that let + - * / and sqrt give other bits than IEEE 754 says. Included by what
// everything simulated is made of. A contraction (a * b + c rounded once) leaves no mark that could be
// refused here: the table of hashes of cmake/proof shows it.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    (defined(__GCC_IEC_559) && __GCC_IEC_559 < 1)
#error "woodlouse promises the same bits everywhere: build without -ffast-math, -Ofast and their parts"
#endif
