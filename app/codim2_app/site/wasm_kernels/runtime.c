typedef __INT64_TYPE__ int64_t; typedef __INT32_TYPE__ int32_t; typedef __UINT32_TYPE__ uint32_t; typedef __INT8_TYPE__ int8_t;
typedef __UINTPTR_TYPE__ uintptr_t; typedef __SIZE_TYPE__ size_t;
extern void *malloc(size_t); extern void free(void *); extern double frexp(double, int *); extern double ldexp(double, int);
/* Numba's runtime, as far as the kernels ask for it. */
typedef struct { int64_t refct; void *dtor, *info, *data; int64_t size; void *ext; } MemInfo;
MemInfo *NRT_MemInfo_alloc_aligned(int64_t size, uint32_t align) {
    char *base = malloc(sizeof(MemInfo) + 2 * align + (size_t)size);
    if (!base) return 0;
    MemInfo *m = (MemInfo *)base;
    uintptr_t p = (uintptr_t)(base + sizeof(MemInfo));
    p = (p + align - 1) / align * align;
    m->refct = 1; m->dtor = m->info = 0; m->data = (void *)p; m->size = size; m->ext = 0;
    return m;
}
MemInfo *NRT_MemInfo_alloc(int64_t size) { return NRT_MemInfo_alloc_aligned(size, 16); }
static void varsize_dtor(void *data, size_t size, void *info) { if (info) ((void (*)(void *))info)(data); free(data); }
MemInfo *NRT_MemInfo_new_varsize_dtor(int64_t size, void *dtor) {
    MemInfo *m = malloc(sizeof(MemInfo));
    m->refct = 1; m->dtor = (void *)varsize_dtor; m->info = dtor; m->data = malloc((size_t)size); m->size = size; m->ext = 0;
    return m;
}
void *NRT_Allocate(int64_t size) { return malloc((size_t)size); }
void NRT_Free(void *p) { free(p); }
void NRT_MemInfo_call_dtor(MemInfo *m) { if (m->dtor) ((void (*)(void *, size_t, void *))m->dtor)(m->data, (size_t)m->size, m->info); free(m); }
double numba_frexp(double x, int *e) { return frexp(x, e); }
double numba_ldexp(double x, int e) { return ldexp(x, e); }
static void release(MemInfo *m) { if (m && --m->refct == 0) NRT_MemInfo_call_dtor(m); }
/* Contiguous arrays only; Numba's own is 100 lines. */
int32_t numba_attempt_nocopy_reshape(int64_t nd, const int64_t *dims, const int64_t *strides, int64_t nnd, const int64_t *ndims, int64_t *nstrides, int64_t item, int32_t fortran) {
    int64_t run = item;
    if (fortran) return 0;
    for (int64_t i = nd - 1; i >= 0; i--) { if (dims[i] != 1 && strides[i] != run) return 0; run *= dims[i]; }
    run = item;
    for (int64_t i = nnd - 1; i >= 0; i--) { nstrides[i] = run; run *= ndims[i]; }
    return 1;
}
int numba_fatal_error(void) { __builtin_trap(); }
