// Dormand and Prince's method of order 8 with its error estimates of order 5 and 3 (E. Hairer, S. P. Norsett,
// G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993, II.5 and II.10), in long double, for
// equations that do not name the time. Whoever uses it chooses the step; nothing of shared/physics is in it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace woodlouse::lab::reference {

/// What the reference computes with: 64 bits of mantissa on x86.
using Real = long double;

namespace dop853 {

inline constexpr std::size_t kCalls = 12;
/// Row i: of which slopes stage i is made.
inline constexpr Real kStage[kCalls][kCalls - 1] = {
    {},
    {5.26001519587677318785587544488e-2L},
    {1.97250569845378994544595329183e-2L, 5.91751709536136983633785987549e-2L},
    {2.95875854768068491816892993775e-2L, 0, 8.87627564304205475450678981324e-2L},
    {2.41365134159266685502369798665e-1L, 0, -8.84549479328286085344864962717e-1L,
     9.24834003261792003115737966543e-1L},
    {3.7037037037037037037037037037e-2L, 0, 0, 1.70828608729473871279604482173e-1L,
     1.25467687566822425016691814123e-1L},
    {3.7109375e-2L, 0, 0, 1.70252211019544039314978060272e-1L, 6.02165389804559606850219397283e-2L,
     -1.7578125e-2L},
    {3.70920001185047927108779319836e-2L, 0, 0, 1.70383925712239993810214054705e-1L,
     1.07262030446373284651809199168e-1L, -1.53194377486244017527936158236e-2L,
     8.27378916381402288758473766002e-3L},
    {6.24110958716075717114429577812e-1L, 0, 0, -3.36089262944694129406857109825L,
     -8.68219346841726006818189891453e-1L, 2.75920996994467083049415600797e1L,
     2.01540675504778934086186788979e1L, -4.34898841810699588477366255144e1L},
    {4.77662536438264365890433908527e-1L, 0, 0, -2.48811461997166764192642586468L,
     -5.90290826836842996371446475743e-1L, 2.12300514481811942347288949897e1L,
     1.52792336328824235832596922938e1L, -3.32882109689848629194453265587e1L,
     -2.03312017085086261358222928593e-2L},
    {-9.3714243008598732571704021658e-1L, 0, 0, 5.18637242884406370830023853209L,
     1.09143734899672957818500254654L, -8.14978701074692612513997267357L, -1.85200656599969598641566180701e1L,
     2.27394870993505042818970056734e1L, 2.49360555267965238987089396762L, -3.0467644718982195003823669022L},
    {2.27331014751653820792359768449L, 0, 0, -1.05344954667372501984066689879e1L,
     -2.00087205822486249909675718444L, -1.79589318631187989172765950534e1L,
     2.79488845294199600508499808837e1L, -2.85899827713502369474065508674L, -8.87285693353062954433549289258L,
     1.23605671757943030647266201528e1L, 6.43392746015763530355970484046e-1L}};
inline constexpr Real kEnd[kCalls] = {5.42937341165687622380535766363e-2L,
                                      0,
                                      0,
                                      0,
                                      0,
                                      4.45031289275240888144113950566L,
                                      1.89151789931450038304281599044L,
                                      -5.8012039600105847814672114227L,
                                      3.1116436695781989440891606237e-1L,
                                      -1.52160949662516078556178806805e-1L,
                                      2.01365400804030348374776537501e-1L,
                                      4.47106157277725905176885569043e-2L};
inline constexpr Real kErrorOfFive[kCalls] = {0.1312004499419488073250102996e-1L,
                                              0,
                                              0,
                                              0,
                                              0,
                                              -0.1225156446376204440720569753e+1L,
                                              -0.4957589496572501915214079952L,
                                              0.1664377182454986536961530415e+1L,
                                              -0.3503288487499736816886487290L,
                                              0.3341791187130174790297318841L,
                                              0.8192320648511571246570742613e-1L,
                                              -0.2235530786388629525884427845e-1L};
/// What the formula of order 3 takes of slopes 1, 9 and 12.
inline constexpr Real kOfThree[3] = {0.244094488188976377952755905512L, 0.733846688281611857341361741547L,
                                     0.220588235294117647058823529412e-1L};

}  // namespace dop853

template <std::size_t kSize>
using Values = std::array<Real, kSize>;

template <std::size_t kSize>
struct Dop853Step {
  Values<kSize> end;
  Real error = 0;  ///< the largest of the components', estimated
};

/// One step of h from `start`; slope(values) is their derivative by time.
template <std::size_t kSize, typename Slope>
Dop853Step<kSize> dop853_step(const Values<kSize>& start, Real h, const Slope& slope) {
  using namespace dop853;
  std::array<Values<kSize>, kCalls> slopes;
  for (std::size_t stage = 0; stage < kCalls; ++stage) {
    Values<kSize> at = start;
    for (std::size_t j = 0; j < stage; ++j) {
      const Real share = kStage[stage][j];
      if (share == 0) continue;
      for (std::size_t i = 0; i < kSize; ++i) at[i] += h * share * slopes[j][i];
    }
    slopes[stage] = slope(at);
  }
  Dop853Step<kSize> result;
  for (std::size_t i = 0; i < kSize; ++i) {
    Real sum = 0, of_five = 0;
    for (std::size_t j = 0; j < kCalls; ++j) {
      sum += kEnd[j] * slopes[j][i];
      of_five += kErrorOfFive[j] * slopes[j][i];
    }
    const Real of_three =
        sum - kOfThree[0] * slopes[0][i] - kOfThree[1] * slopes[8][i] - kOfThree[2] * slopes[11][i];
    result.end[i] = start[i] + h * sum;
    const Real length = std::sqrt(of_five * of_five + 0.01L * of_three * of_three);
    const Real error = length > 0 ? std::fabs(h) * of_five * of_five / length : 0;
    if (!(error <= result.error)) result.error = error;
  }
  return result;
}

}  // namespace woodlouse::lab::reference
