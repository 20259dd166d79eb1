// SPDX-License-Identifier: GPL-2.0
/*
 * SPDX-FileCopyrightText: 2026 The VeriCAN authors
 *
 * ptp_verican: what happens at a time: time stamps of the pin ext_i, the output at the pin
 * time_out_o, and a pulse a second, which shares the compare unit with the output.
 */
#include <linux/jiffies.h>
#include <linux/math64.h>

#include "ptp_verican.h"

/* Least distance of two events of the compare unit, clocks. */
#define MIN_HALF_CLOCKS 16
/* The compare unit sees half of 2^32 ns ahead. */
#define OUTPUT_LEAD (2ULL * NSEC_PER_SEC)
/* With a pulse a second running, its own low half: the output is let out in there. */
#define OUTPUT_LEAD_PPS (400ULL * NSEC_PER_MSEC)
/* From reading the time until the compare unit is armed; later it would fire at once. */
#define ARM_TIME (20ULL * NSEC_PER_USEC)

/* ---- Compare unit: output and pulses */

static u64 next_edge(u64 first, u64 period, u64 after)
{
	u64 rest;

	if (first > after)
		return first;
	div64_u64_rem(after - first, period, &rest);
	return after - rest + period;
}

static void verican_run_compare(struct verican_ptp *vp, u64 first, u32 half, u64 now, bool out)
{
	verican_change_ctrl(vp, TCTRL_CMP, TCTRL_CMPEN);
	verican_write(vp, TCMPH, half);
	verican_write(vp, TCMP, lower_32_bits(next_edge(first, 2ULL * half, now + ARM_TIME)));
	verican_write(vp, TSTAT, TSTAT_CMP);
	verican_change_ctrl(vp, 0, (out ? TCTRL_OUTEN : 0) | (vp->pps ? TCTRL_CMPIE : 0));
}

/*
 * Sets the compare unit up for what is wanted, as the time is now. Returns ns until it has to be
 * called again, negative: never.
 */
static s64 verican_arm(struct verican_ptp *vp)
{
	u64 now = verican_now(vp, NULL);
	u64 lead = vp->pps ? OUTPUT_LEAD_PPS : OUTPUT_LEAD;
	u64 next = vp->out ? next_edge(vp->first, 2ULL * vp->half, now + ARM_TIME) : 0;
	/* Long periods, too, have their next edge beyond what the compare unit sees. */
	bool early = next > now + lead && (!vp->pps || vp->first > now + lead);

	if (vp->pps)
		verican_run_compare(vp, 0, NSEC_PER_SEC / 2, now, vp->out && !early);
	else if (vp->out && !early)
		verican_run_compare(vp, vp->first, vp->half, now, true);
	else
		verican_change_ctrl(vp, TCTRL_CMP, 0);
	return early ? next - lead - now : -1;
}

long verican_do_aux_work(struct ptp_clock_info *info)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);
	unsigned long flags;
	s64 wait;

	spin_lock_irqsave(&vp->lock, flags);
	wait = verican_arm(vp);
	spin_unlock_irqrestore(&vp->lock, flags);
	/* The clock may be shifted meanwhile, which calls again; an hour keeps jiffies small. */
	return wait < 0 ? -1 : nsecs_to_jiffies(min_t(u64, wait, 3600ULL * NSEC_PER_SEC)) + 1;
}

/* After a jump of the clock, or a change of what is wanted. */
void verican_rearm(struct verican_ptp *vp)
{
	if (vp->out || vp->pps)
		ptp_schedule_worker(vp->clock, 0);
}

/* ---- Pins and pulses */

static int verican_enable_extts(struct verican_ptp *vp, const struct ptp_extts_request *request,
				int on)
{
	u32 edges = 0;
	unsigned long flags;

	if (request->flags &
	    ~(PTP_ENABLE_FEATURE | PTP_RISING_EDGE | PTP_FALLING_EDGE | PTP_STRICT_FLAGS))
		return -EOPNOTSUPP;
	if (request->flags & PTP_RISING_EDGE || !(request->flags & PTP_FALLING_EDGE))
		edges |= TCTRL_EXTR;
	if (request->flags & PTP_FALLING_EDGE)
		edges |= TCTRL_EXTF;
	spin_lock_irqsave(&vp->lock, flags);
	verican_change_ctrl(vp, TCTRL_EXT, 0);
	verican_write(vp, TSTAT, TSTAT_EXT | TSTAT_EXTOVR);
	if (on)
		verican_change_ctrl(vp, 0, edges | TCTRL_EXTIE);
	spin_unlock_irqrestore(&vp->lock, flags);
	return 0;
}

static u64 time_to_ns(const struct ptp_clock_time *time)
{
	return time->sec * NSEC_PER_SEC + time->nsec;
}

/* An output beside the pulses must rise with them. */
static bool in_phase(u64 first, u32 half)
{
	u64 rest;

	div64_u64_rem(first, NSEC_PER_SEC, &rest);
	return half == NSEC_PER_SEC / 2 && rest == 0;
}

static int verican_enable_perout(struct verican_ptp *vp, const struct ptp_perout_request *request,
				 int on)
{
	u64 period = time_to_ns(&request->period);
	u64 least = (2 * MIN_HALF_CLOCKS * vp->increment) >> 48;
	u64 first =
		time_to_ns(request->flags & PTP_PEROUT_PHASE ? &request->phase : &request->start);
	unsigned long flags;
	int rc = 0;

	if (request->flags & ~(PTP_PEROUT_DUTY_CYCLE | PTP_PEROUT_PHASE))
		return -EOPNOTSUPP;
	if (on && (request->period.sec > 4 || period / 2 > S32_MAX || period < least || period % 2))
		return -ERANGE;
	if (on && request->flags & PTP_PEROUT_DUTY_CYCLE && time_to_ns(&request->on) != period / 2)
		return -EOPNOTSUPP;
	spin_lock_irqsave(&vp->lock, flags);
	if (on && vp->pps && !in_phase(first, period / 2)) {
		rc = -EBUSY;
	} else {
		vp->out = on;
		vp->first = first;
		vp->half = period / 2;
	}
	spin_unlock_irqrestore(&vp->lock, flags);
	if (!rc)
		ptp_schedule_worker(vp->clock, 0);
	return rc;
}

static int verican_enable_pps(struct verican_ptp *vp, int on)
{
	unsigned long flags;
	int rc = 0;

	spin_lock_irqsave(&vp->lock, flags);
	if (on && vp->out && !in_phase(vp->first, vp->half))
		rc = -EBUSY;
	else
		vp->pps = on;
	spin_unlock_irqrestore(&vp->lock, flags);
	if (!rc)
		ptp_schedule_worker(vp->clock, 0);
	return rc;
}

int verican_enable(struct ptp_clock_info *info, struct ptp_clock_request *request, int on)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);

	switch (request->type) {
	case PTP_CLK_REQ_EXTTS:
		return verican_enable_extts(vp, &request->extts, on);
	case PTP_CLK_REQ_PEROUT:
		return verican_enable_perout(vp, &request->perout, on);
	case PTP_CLK_REQ_PPS:
		return verican_enable_pps(vp, on);
	default:
		return -EOPNOTSUPP;
	}
}

irqreturn_t verican_irq(int irq, void *data)
{
	struct verican_ptp *vp = data;
	struct ptp_clock_event event = { .index = 0 };
	u32 status;

	spin_lock(&vp->lock);
	status = verican_read(vp, TSTAT) & (TSTAT_EXT | TSTAT_CMP | TSTAT_OUT);
	if (status & TSTAT_EXT) {
		event.timestamp = verican_read(vp, TEXTLO);
		event.timestamp |= (u64)verican_read(vp, TEXTHI) << 32;
		event.timestamp -= vp->ext_latency;
		verican_write(vp, TSTAT, TSTAT_EXT | TSTAT_EXTOVR);
	}
	if (status & TSTAT_CMP)
		verican_write(vp, TSTAT, TSTAT_CMP);
	spin_unlock(&vp->lock);

	if (status & TSTAT_EXT) {
		event.type = PTP_CLOCK_EXTTS;
		ptp_clock_event(vp->clock, &event);
	}
	/* The output is high in the first half of each second. */
	if (status & TSTAT_CMP && status & TSTAT_OUT && vp->pps) {
		event.type = PTP_CLOCK_PPS;
		ptp_clock_event(vp->clock, &event);
	}
	return status & (TSTAT_EXT | TSTAT_CMP) ? IRQ_HANDLED : IRQ_NONE;
}
