#include "hm_measure.h"

#include <math.h>

static bool is_worse(const struct hm_measure_kind *kind, double a, double b)
{
    return kind->small_is_bad ? a < b : a > b;
}

static void keep_worst(struct hm_measure *m, const struct hm_measure_kind *kind,
                       struct hm_measured new)
{
    int k = m->nworst;
    if (k == HM_MEASURE_WORST && !is_worse(kind, new.value, m->worst[--k].value))
        return;
    for (; k > 0 && is_worse(kind, new.value, m->worst[k - 1].value); k--)
        m->worst[k] = m->worst[k - 1];
    m->worst[k] = new;
    if (m->nworst < HM_MEASURE_WORST)
        m->nworst++;
}

/* The last bin that does not begin above the value, by halving. */
static int bin_of(const struct hm_measure_kind *kind, double value)
{
    int low = 0, high = kind->bins;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (value >= kind->limit[middle])
            low = middle;
        else
            high = middle;
    }
    return low;
}

void hm_measure_add(struct hm_measure *m, const struct hm_measure_kind *kind, double value,
                    double x, double y)
{
    if (isnan(value))
        return;
    const struct hm_measured new = {value, x, y};
    if (m->n == 0 || value < m->least.value)
        m->least = new;
    if (m->n == 0 || value > m->most.value)
        m->most = new;
    m->n++;
    m->sum += value;
    m->bin[bin_of(kind, value)]++;
    keep_worst(m, kind, new);
}

double hm_measure_mean(const struct hm_measure *m)
{
    return m->n ? m->sum / (double)m->n : NAN;
}

double hm_measure_least(const struct hm_measure *m)
{
    return m->n ? m->least.value : NAN;
}

double hm_measure_most(const struct hm_measure *m)
{
    return m->n ? m->most.value : NAN;
}
