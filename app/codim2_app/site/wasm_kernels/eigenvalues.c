/* Eigenvalues of a small complex matrix, as Numba asks LAPACK for them: elimination to Hessenberg form, then QR steps
   with Wilkinson's shift (Wilkinson, The Algebraic Eigenvalue Problem, 1965, chapters 6 and 8). No eigenvectors. */
typedef struct { double r, i; } z;
static z plus(z a, z b) { return (z){a.r + b.r, a.i + b.i}; }
static z minus(z a, z b) { return (z){a.r - b.r, a.i - b.i}; }
static z times(z a, z b) { return (z){a.r * b.r - a.i * b.i, a.r * b.i + a.i * b.r}; }
static z conjugate(z a) { return (z){a.r, -a.i}; }
static z scaled(z a, double t) { return (z){a.r * t, a.i * t}; }
static double size(z a) { return __builtin_fabs(a.r) + __builtin_fabs(a.i); }
static double square(z a) { return a.r * a.r + a.i * a.i; }
static z over(z a, z b) { return scaled(times(a, conjugate(b)), 1.0 / square(b)); }
static z root(z a) {
    double m = __builtin_sqrt(__builtin_sqrt(square(a)) / 2.0 + __builtin_fabs(a.r) / 2.0);
    if (m == 0.0) return (z){0.0, 0.0};
    return a.r >= 0.0 ? (z){m, a.i / (2.0 * m)} : (z){__builtin_fabs(a.i) / (2.0 * m), a.i < 0.0 ? -m : m};
}
#define MOST 64
#define A(i, j) a[(i) + (j) * lda]

static void to_hessenberg(int64_t n, z *a, int64_t lda) {
    for (int64_t m = 1; m + 1 < n; m++) {
        int64_t pivot = m;
        for (int64_t i = m + 1; i < n; i++) if (size(A(i, m - 1)) > size(A(pivot, m - 1))) pivot = i;
        if (size(A(pivot, m - 1)) == 0.0) continue;
        if (pivot != m) {
            for (int64_t j = m - 1; j < n; j++) { z t = A(pivot, j); A(pivot, j) = A(m, j); A(m, j) = t; }
            for (int64_t i = 0; i < n; i++) { z t = A(i, pivot); A(i, pivot) = A(i, m); A(i, m) = t; }
        }
        for (int64_t i = m + 1; i < n; i++) {
            z y = over(A(i, m - 1), A(m, m - 1));
            for (int64_t j = m - 1; j < n; j++) A(i, j) = minus(A(i, j), times(y, A(m, j)));
            for (int64_t k = 0; k < n; k++) A(k, m) = plus(A(k, m), times(y, A(k, i)));
            A(i, m - 1) = (z){0.0, 0.0};
        }
    }
}

static z shift_of(z *a, int64_t lda, int64_t hi) {
    z half = scaled(minus(A(hi - 1, hi - 1), A(hi, hi)), 0.5), away = times(A(hi, hi - 1), A(hi - 1, hi));
    z s = root(plus(times(half, half), away));
    z low = minus(half, s), high = plus(half, s);
    return plus(A(hi, hi), square(low) < square(high) ? low : high);
}

int32_t numba_ez_cgeev(char kind, char left, char right, int64_t n, z *a, int64_t lda, z *w, void *vl, int64_t ldvl, void *vr, int64_t ldvr) {
    if (kind != 'z' || left != 'N' || right != 'N') return -1;
    if (n > MOST) return -1;
    z p_of[MOST], q_of[MOST]; /* the rotations of a step */
    to_hessenberg(n, a, lda);
    for (int64_t hi = n - 1, tries = 0; hi >= 0;) {
        int64_t low = hi;
        for (; low > 0; low--) if (size(A(low, low - 1)) <= 2.3e-16 * (size(A(low - 1, low - 1)) + size(A(low, low)))) break;
        if (low == hi) { w[hi] = A(hi, hi); hi--; tries = 0; continue; }
        if (++tries > 60) return 1;
        z shift = tries % 10 ? shift_of(a, lda, hi) : (z){size(A(hi, hi - 1)) + A(hi, hi).r, 0.0};
        for (int64_t i = low; i <= hi; i++) A(i, i) = minus(A(i, i), shift);
        for (int64_t k = low; k < hi; k++) {
            double length = __builtin_sqrt(square(A(k, k)) + square(A(k + 1, k)));
            z p = length ? scaled(A(k, k), 1.0 / length) : (z){1.0, 0.0}, q = length ? scaled(A(k + 1, k), 1.0 / length) : (z){0.0, 0.0};
            for (int64_t j = k; j <= hi; j++) {
                z x = A(k, j), y = A(k + 1, j);
                A(k, j) = plus(times(conjugate(p), x), times(conjugate(q), y));
                A(k + 1, j) = minus(times(p, y), times(q, x));
            }
            p_of[k] = p, q_of[k] = q;
        }
        for (int64_t k = low; k < hi; k++)
            for (int64_t i = low; i <= (k + 1 < hi ? k + 1 : hi); i++) {
                z x = A(i, k), y = A(i, k + 1);
                A(i, k) = plus(times(x, p_of[k]), times(y, q_of[k]));
                A(i, k + 1) = minus(times(y, conjugate(p_of[k])), times(x, conjugate(q_of[k])));
            }
        for (int64_t i = low; i <= hi; i++) A(i, i) = plus(A(i, i), shift);
    }
    return 0;
}
