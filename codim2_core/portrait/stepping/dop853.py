"""The Dormand-Prince method of order 8 with error estimates of order 5 and 3, in SIMD lanes, compiled.

Every loop runs over `ROW_WIDTH` neighbouring numbers of one workspace at fixed offsets, which is what lets the compiler
keep them in vector registers; the coefficients stand in the code for the same reason.

E. Hairer, S. P. Norsett, G. Wanner, "Solving Ordinary Differential Equations I", 2nd ed., sec. II.5 and II.6
(dense output), DOP853; printed to double precision.
"""

from __future__ import annotations

from ...formulas.jit import call_field, fast_kernel
from .layout import (
    DENSE_ROWS,
    ERROR_3,
    ERROR_5,
    K0,
    K1,
    K2,
    K3,
    K4,
    K5,
    K6,
    K7,
    K8,
    K9,
    K10,
    K11,
    K12,
    K13,
    K14,
    K15,
    NEW,
    ROW_WIDTH,
    STATE,
    STEP_ROW,
    TRIAL,
)


# `advance` and `interpolate` stand in one piece each: see `lanes.integrate`.
@fast_kernel
def advance(S, P, field):
    """One trial step of every lane: from STATE, K0 and STEP to NEW and the two error estimates."""
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (0.05260015195876773 * S[m + K0])
    call_field(field, S, TRIAL, K1, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.0197250569845379 * S[m + K0] + 0.0591751709536137 * S[m + K1]
        )
    call_field(field, S, TRIAL, K2, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.02958758547680685 * S[m + K0] + 0.08876275643042054 * S[m + K2]
        )
    call_field(field, S, TRIAL, K3, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.2413651341592667 * S[m + K0] + -0.8845494793282861 * S[m + K2] + 0.924834003261792 * S[m + K3]
        )
    call_field(field, S, TRIAL, K4, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.037037037037037035 * S[m + K0] + 0.17082860872947386 * S[m + K3] + 0.12546768756682242 * S[m + K4]
        )
    call_field(field, S, TRIAL, K5, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.037109375 * S[m + K0]
            + 0.17025221101954405 * S[m + K3]
            + 0.06021653898045596 * S[m + K4]
            + -0.017578125 * S[m + K5]
        )
    call_field(field, S, TRIAL, K6, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.03709200011850479 * S[m + K0]
            + 0.17038392571223998 * S[m + K3]
            + 0.10726203044637328 * S[m + K4]
            + -0.015319437748624402 * S[m + K5]
            + 0.008273789163814023 * S[m + K6]
        )
    call_field(field, S, TRIAL, K7, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.6241109587160757 * S[m + K0]
            + -3.3608926294469414 * S[m + K3]
            + -0.868219346841726 * S[m + K4]
            + 27.59209969944671 * S[m + K5]
            + 20.154067550477894 * S[m + K6]
            + -43.48988418106996 * S[m + K7]
        )
    call_field(field, S, TRIAL, K8, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.47766253643826434 * S[m + K0]
            + -2.4881146199716677 * S[m + K3]
            + -0.590290826836843 * S[m + K4]
            + 21.230051448181193 * S[m + K5]
            + 15.279233632882423 * S[m + K6]
            + -33.28821096898486 * S[m + K7]
            + -0.020331201708508627 * S[m + K8]
        )
    call_field(field, S, TRIAL, K9, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            -0.9371424300859873 * S[m + K0]
            + 5.186372428844064 * S[m + K3]
            + 1.0914373489967295 * S[m + K4]
            + -8.149787010746927 * S[m + K5]
            + -18.52006565999696 * S[m + K6]
            + 22.739487099350505 * S[m + K7]
            + 2.4936055526796523 * S[m + K8]
            + -3.0467644718982196 * S[m + K9]
        )
    call_field(field, S, TRIAL, K10, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            2.273310147516538 * S[m + K0]
            + -10.53449546673725 * S[m + K3]
            + -2.0008720582248625 * S[m + K4]
            + -17.9589318631188 * S[m + K5]
            + 27.94888452941996 * S[m + K6]
            + -2.8589982771350235 * S[m + K7]
            + -8.87285693353063 * S[m + K8]
            + 12.360567175794303 * S[m + K9]
            + 0.6433927460157636 * S[m + K10]
        )
    call_field(field, S, TRIAL, K11, P)
    for m in range(ROW_WIDTH):
        S[m + NEW] = S[m + STATE] + S[m + STEP_ROW] * (
            0.054293734116568765 * S[m + K0]
            + 4.450312892752409 * S[m + K5]
            + 1.8915178993145003 * S[m + K6]
            + -5.801203960010585 * S[m + K7]
            + 0.3111643669578199 * S[m + K8]
            + -0.1521609496625161 * S[m + K9]
            + 0.20136540080403034 * S[m + K10]
            + 0.04471061572777259 * S[m + K11]
        )
    for m in range(ROW_WIDTH):
        S[m + ERROR_5] = S[m + STEP_ROW] * (
            0.01312004499419488 * S[m + K0]
            + -1.2251564463762044 * S[m + K5]
            + -0.4957589496572502 * S[m + K6]
            + 1.6643771824549864 * S[m + K7]
            + -0.35032884874997366 * S[m + K8]
            + 0.3341791187130175 * S[m + K9]
            + 0.08192320648511571 * S[m + K10]
            + -0.022355307863886294 * S[m + K11]
        )
    for m in range(ROW_WIDTH):
        S[m + ERROR_3] = S[m + STEP_ROW] * (
            -0.18980075407240762 * S[m + K0]
            + 4.450312892752409 * S[m + K5]
            + 1.8915178993145003 * S[m + K6]
            + -5.801203960010585 * S[m + K7]
            + -0.4226823213237919 * S[m + K8]
            + -0.1521609496625161 * S[m + K9]
            + 0.20136540080403034 * S[m + K10]
            + 0.02265179219836082 * S[m + K11]
        )


@fast_kernel
def interpolate(S, P, field):
    """Dense output of order 7 of the step just tried: three further stages; K12 is the field at NEW."""
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.056167502283047954 * S[m + K0]
            + 0.25350021021662483 * S[m + K6]
            + -0.2462390374708025 * S[m + K7]
            + -0.12419142326381637 * S[m + K8]
            + 0.15329179827876568 * S[m + K9]
            + 0.00820105229563469 * S[m + K10]
            + 0.007567897660545699 * S[m + K11]
            + -0.008298 * S[m + K12]
        )
    call_field(field, S, TRIAL, K13, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            0.03183464816350214 * S[m + K0]
            + 0.028300909672366776 * S[m + K5]
            + 0.053541988307438566 * S[m + K6]
            + -0.05492374857139099 * S[m + K7]
            + -0.00010834732869724932 * S[m + K10]
            + 0.0003825710908356584 * S[m + K11]
            + -0.00034046500868740456 * S[m + K12]
            + 0.1413124436746325 * S[m + K13]
        )
    call_field(field, S, TRIAL, K14, P)
    for m in range(ROW_WIDTH):
        S[m + TRIAL] = S[m + STATE] + S[m + STEP_ROW] * (
            -0.42889630158379194 * S[m + K0]
            + -4.697621415361164 * S[m + K5]
            + 7.683421196062599 * S[m + K6]
            + 4.06898981839711 * S[m + K7]
            + 0.3567271874552811 * S[m + K8]
            + -0.0013990241651590145 * S[m + K12]
            + 2.9475147891527724 * S[m + K13]
            + -9.15095847217987 * S[m + K14]
        )
    call_field(field, S, TRIAL, K15, P)
    for m in range(ROW_WIDTH):
        difference = S[m + NEW] - S[m + STATE]
        h = S[m + STEP_ROW]
        S[m + DENSE_ROWS] = difference
        S[m + DENSE_ROWS + ROW_WIDTH] = h * S[m + K0] - difference
        S[m + DENSE_ROWS + 2 * ROW_WIDTH] = 2.0 * difference - h * (S[m + K12] + S[m + K0])
    for m in range(ROW_WIDTH):
        S[m + DENSE_ROWS + 3 * ROW_WIDTH] = S[m + STEP_ROW] * (
            -8.428938276109013 * S[m + K0]
            + 0.5667149535193777 * S[m + K5]
            + -3.0689499459498917 * S[m + K6]
            + 2.38466765651207 * S[m + K7]
            + 2.117034582445028 * S[m + K8]
            + -0.871391583777973 * S[m + K9]
            + 2.2404374302607883 * S[m + K10]
            + 0.6315787787694688 * S[m + K11]
            + -0.08899033645133331 * S[m + K12]
            + 18.148505520854727 * S[m + K13]
            + -9.194632392478356 * S[m + K14]
            + -4.436036387594894 * S[m + K15]
        )
    for m in range(ROW_WIDTH):
        S[m + DENSE_ROWS + 4 * ROW_WIDTH] = S[m + STEP_ROW] * (
            10.427508642579134 * S[m + K0]
            + 242.28349177525817 * S[m + K5]
            + 165.20045171727028 * S[m + K6]
            + -374.5467547226902 * S[m + K7]
            + -22.113666853125306 * S[m + K8]
            + 7.733432668472264 * S[m + K9]
            + -30.674084731089398 * S[m + K10]
            + -9.332130526430229 * S[m + K11]
            + 15.697238121770845 * S[m + K12]
            + -31.139403219565178 * S[m + K13]
            + -9.35292435884448 * S[m + K14]
            + 35.81684148639408 * S[m + K15]
        )
    for m in range(ROW_WIDTH):
        S[m + DENSE_ROWS + 5 * ROW_WIDTH] = S[m + STEP_ROW] * (
            19.985053242002433 * S[m + K0]
            + -387.0373087493518 * S[m + K5]
            + -189.17813819516758 * S[m + K6]
            + 527.8081592054236 * S[m + K7]
            + -11.57390253995963 * S[m + K8]
            + 6.8812326946963 * S[m + K9]
            + -1.0006050966910838 * S[m + K10]
            + 0.7777137798053443 * S[m + K11]
            + -2.778205752353508 * S[m + K12]
            + -60.19669523126412 * S[m + K13]
            + 84.32040550667716 * S[m + K14]
            + 11.99229113618279 * S[m + K15]
        )
    for m in range(ROW_WIDTH):
        S[m + DENSE_ROWS + 6 * ROW_WIDTH] = S[m + STEP_ROW] * (
            -25.69393346270375 * S[m + K0]
            + -154.18974869023643 * S[m + K5]
            + -231.5293791760455 * S[m + K6]
            + 357.6391179106141 * S[m + K7]
            + 93.40532418362432 * S[m + K8]
            + -37.45832313645163 * S[m + K9]
            + 104.0996495089623 * S[m + K10]
            + 29.8402934266605 * S[m + K11]
            + -43.53345659001114 * S[m + K12]
            + 96.32455395918828 * S[m + K13]
            + -39.17726167561544 * S[m + K14]
            + -149.72683625798564 * S[m + K15]
        )


@fast_kernel
def dense(S, m, x):
    """Value of number m of the state, and its derivative in x, at the fraction x of the step in DENSE."""
    u = 1.0 - x
    value = 0.0
    slope = 0.0
    for i in range(6, -1, -1):
        value += S[m + DENSE_ROWS + i * ROW_WIDTH]
        if i % 2 == 0:
            slope = slope * x + value
            value *= x
        else:
            slope = slope * u - value
            value *= u
    return value + S[m + STATE], slope
