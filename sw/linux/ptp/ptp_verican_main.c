// SPDX-License-Identifier: GPL-2.0
/*
 * SPDX-FileCopyrightText: 2026 The VeriCAN authors
 *
 * ptp_verican: the time unit of a VeriCAN as a PTP hardware clock: time, rate and phase; external
 * time stamps and outputs are in ptp_verican_events.c. The rules are those of docs/time-spec.md,
 * section 10. The CAN controller has a driver of its own.
 */
#include <linux/bitfield.h>
#include <linux/clk.h>
#include <linux/math64.h>
#include <linux/module.h>
#include <linux/of.h>
#include <linux/platform_device.h>

#include "ptp_verican.h"

#define MAX_PPB 100000000

/*
 * floor(value * factor / divisor) by long division, 16 bits at a time; the result must fit.
 * factor < 2^47, divisor < 2^47.
 */
static u64 mul_div(u64 value, u64 factor, u64 divisor)
{
	u64 result = 0, rest = 0;
	int shift;

	for (shift = 48; shift >= 0; shift -= 16) {
		u64 part = (rest << 16) + ((value >> shift) & 0xffff) * factor;

		result = (result << 16) + div64_u64_rem(part, divisor, &rest);
	}
	return result;
}

static void verican_set_increment(struct verican_ptp *vp, u64 increment)
{
	u64 rounded = (increment + BIT(15)) >> 16;

	verican_write_pair(vp, TINCN, upper_32_bits(rounded), lower_32_bits(rounded));
}

/* ---- Clock */

static int verican_gettimex64(struct ptp_clock_info *info, struct timespec64 *ts,
			      struct ptp_system_timestamp *sts)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);
	unsigned long flags;
	u32 rest;
	u64 now;

	spin_lock_irqsave(&vp->lock, flags);
	now = verican_now(vp, sts);
	spin_unlock_irqrestore(&vp->lock, flags);
	ts->tv_sec = div_u64_rem(now, NSEC_PER_SEC, &rest);
	ts->tv_nsec = rest;
	return 0;
}

/*
 * The compare unit would follow a jump event by event until it has caught up, and tell of a second
 * that was leapt over. It stands until the worker has armed it for the new time. A slew was asked
 * for in the time of before: it ends where another one is set.
 */
static void verican_jump(struct verican_ptp *vp, unsigned int offset, u64 ns)
{
	unsigned long flags;

	spin_lock_irqsave(&vp->lock, flags);
	verican_change_ctrl(vp, TCTRL_CMP, 0);
	if (offset == TIMELO)
		verican_write(vp, TSLEW, 0);
	verican_write_pair(vp, offset, lower_32_bits(ns), upper_32_bits(ns));
	spin_unlock_irqrestore(&vp->lock, flags);
	verican_rearm(vp);
}

static int verican_settime64(struct ptp_clock_info *info, const struct timespec64 *ts)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);

	verican_jump(vp, TIMELO, (u64)ts->tv_sec * NSEC_PER_SEC + ts->tv_nsec);
	return 0;
}

static int verican_adjtime(struct ptp_clock_info *info, s64 delta)
{
	verican_jump(container_of(info, struct verican_ptp, info), TSHLO, delta);
	return 0;
}

/* scaled_ppm: 2^-16 ppm */
static int verican_adjfine(struct ptp_clock_info *info, long scaled_ppm)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);
	u64 change = mul_div(vp->increment, abs((s64)scaled_ppm), 1000000ULL << 16);
	u64 increment = scaled_ppm < 0 ? vp->increment - change : vp->increment + change;
	unsigned long flags;

	spin_lock_irqsave(&vp->lock, flags);
	verican_set_increment(vp, increment);
	spin_unlock_irqrestore(&vp->lock, flags);
	return 0;
}

static int verican_adjphase(struct ptp_clock_info *info, s32 phase)
{
	struct verican_ptp *vp = container_of(info, struct verican_ptp, info);
	unsigned long flags;

	spin_lock_irqsave(&vp->lock, flags);
	verican_write(vp, TSLEW, phase);
	spin_unlock_irqrestore(&vp->lock, flags);
	return 0;
}

/* ---- Set-up */

static const struct ptp_clock_info verican_ptp_info = {
	.owner = THIS_MODULE,
	.name = "verican",
	.max_adj = MAX_PPB,
	.n_per_out = 1,
	.gettimex64 = verican_gettimex64,
	.settime64 = verican_settime64,
	.adjtime = verican_adjtime,
	.adjfine = verican_adjfine,
	.adjphase = verican_adjphase,
	.enable = verican_enable,
	.do_aux_work = verican_do_aux_work,
};

/* The rate of hclk in Hz, 0: nobody knows it. A clock that is still to come is an error. */
static int verican_rate(struct device *dev, unsigned long *rate)
{
	struct clk *clk = devm_clk_get_optional_enabled(dev, NULL);
	u32 frequency = 0;

	if (IS_ERR(clk))
		return PTR_ERR(clk);
	if (!clk)
		of_property_read_u32(dev->of_node, "clock-frequency", &frequency);
	*rate = clk ? clk_get_rate(clk) : frequency;
	return 0;
}

/* Nothing is on but the clock itself; its time stays. */
static int verican_start(struct verican_ptp *vp, unsigned long rate)
{
	u64 half_clocks;

	/* TINCN has 8 bits, and the clock has to slew and to be MAX_PPB faster. */
	if (rate < 5000000 || rate > 500000000)
		return -ERANGE;
	vp->increment = mul_div(BIT_ULL(48), NSEC_PER_SEC, rate);
	half_clocks = FIELD_GET(TCAP_RXLAT, verican_read(vp, TCAP));
	vp->ext_latency = (half_clocks * vp->increment + BIT_ULL(48)) >> 49;
	verican_change_ctrl(vp, TCTRL_IE | TCTRL_EXT | TCTRL_CMP, 0);
	verican_write(vp, TSTAT, TSTAT_FLAGS);
	verican_write(vp, TSLEW, 0);
	verican_set_increment(vp, vp->increment);
	return 0;
}

/* No more events; the time goes on. */
static void verican_silence(struct verican_ptp *vp)
{
	unsigned long flags;

	spin_lock_irqsave(&vp->lock, flags);
	verican_change_ctrl(vp, TCTRL_IE | TCTRL_EXT | TCTRL_CMP, 0);
	spin_unlock_irqrestore(&vp->lock, flags);
}

static int verican_probe(struct platform_device *pdev)
{
	struct device *dev = &pdev->dev;
	struct verican_ptp *vp = devm_kzalloc(dev, sizeof(*vp), GFP_KERNEL);
	unsigned long rate;
	int rc;

	if (!vp)
		return -ENOMEM;
	rc = verican_rate(dev, &rate);
	if (rc)
		return dev_err_probe(dev, rc, "no clock\n");
	vp->irq = platform_get_irq_optional(pdev, 0);
	if (vp->irq == -EPROBE_DEFER)
		return vp->irq;
	vp->base = devm_platform_ioremap_resource(pdev, 0);
	if (IS_ERR(vp->base))
		return PTR_ERR(vp->base);
	if (verican_read(vp, XID) != XID_VCAN || !(verican_read(vp, XCONFIG) & XCONFIG_TIME))
		return dev_err_probe(dev, -ENODEV, "no time unit here\n");
	spin_lock_init(&vp->lock);
	rc = verican_start(vp, rate);
	if (rc)
		return dev_err_probe(dev, rc, "clock of %lu Hz; 5 to 500 MHz\n", rate);
	vp->info = verican_ptp_info;
	vp->info.n_ext_ts = vp->irq > 0;
	vp->info.pps = vp->irq > 0;
	platform_set_drvdata(pdev, vp);
	vp->clock = ptp_clock_register(&vp->info, dev);
	if (IS_ERR_OR_NULL(vp->clock))
		return vp->clock ? PTR_ERR(vp->clock) : -EOPNOTSUPP;
	/* The line is silent until somebody asks for an event. */
	rc = vp->irq > 0 ? devm_request_irq(dev, vp->irq, verican_irq, 0, dev_name(dev), vp) : 0;
	if (rc)
		ptp_clock_unregister(vp->clock);
	return rc;
}

static int verican_remove(struct platform_device *pdev)
{
	struct verican_ptp *vp = platform_get_drvdata(pdev);

	verican_silence(vp);
	/* The handler uses the clock: it must have ended, for good, before that is freed. */
	if (vp->irq > 0)
		devm_free_irq(&pdev->dev, vp->irq, vp);
	ptp_clock_unregister(vp->clock);
	/* Until then the clock's worker, or who has it open, could ask for events anew. */
	verican_silence(vp);
	return 0;
}

static const struct of_device_id verican_of_match[] = {
	{ .compatible = "verican,time-1.0" },
	{},
};
MODULE_DEVICE_TABLE(of, verican_of_match);

static struct platform_driver verican_driver = {
	.probe = verican_probe,
	.remove = verican_remove,
	.driver = {
		.name = "ptp_verican",
		.of_match_table = verican_of_match,
	},
};
module_platform_driver(verican_driver);

MODULE_DESCRIPTION("PTP hardware clock of VeriCAN's time unit");
MODULE_LICENSE("GPL");
