/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A time domain on a core: how it begins, and what can be known of it (TM-91).
 */
#include "tsyn_device.h"

verican_result_t verican_tsyn_config_default(verican_tsyn_config_t *config) {
  if (config == NULL) return VERICAN_ERR_NULL;
  *config = (verican_tsyn_config_t){0};
  (void)verican_servo_config_default(&config->servo);
  (void)verican_tsyn_rules_default(&config->rules);
  config->master_count = 1;
  return VERICAN_OK;
}

/* Whether a frame can have this identifier. */
static bool is_identifier(uint32_t id) {
  const bool extended = (id & VERICAN_TSYN_EXTENDED) != 0u;
  return (id & ~VERICAN_TSYN_EXTENDED) <= (extended ? 0x1FFFFFFFu : 0x7FFu);
}

/* Rises from identifiers that win arbitration to those that lose it (AR-06). */
static uint32_t arbitration_rank(uint32_t id) {
  const bool extended = (id & VERICAN_TSYN_EXTENDED) != 0u;
  return extended ? (id & ~VERICAN_TSYN_EXTENDED) << 1 | 1u : id << 19;
}

static bool valid_identifiers(const verican_tsyn_config_t *config) {
  if (!is_identifier(config->delay_request) || !is_identifier(config->delay_response)) return false;
  uint32_t before = 0;
  for (unsigned n = 0; n < config->master_count; ++n) {
    const uint32_t id = config->masters[n];
    const uint32_t rank = arbitration_rank(id);
    if (!is_identifier(id) || (n != 0u && rank <= before)) return false;
    before = rank;
  }
  return true;
}

static bool valid(const verican_tsyn_config_t *config) {
  const verican_tsyn_rules_t *rules = &config->rules;
  return config->master_count >= 1u && config->master_count <= VERICAN_MASTERS &&
         config->rank < config->master_count && rules->domain <= 15u && rules->jump_width >= 1u &&
         rules->jump_width <= 15u && rules->crc <= (uint8_t)VERICAN_TSYN_CRC_OPTIONAL &&
         valid_identifiers(config);
}

verican_result_t verican_tsyn_init(verican_tsyn_t *tsyn, verican_t *dev,
                                   const verican_tsyn_config_t *config) {
  if (tsyn == NULL || config == NULL) return VERICAN_ERR_NULL;
  verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (!dev->time_unit) return VERICAN_ERR_UNSUPPORTED;
  if (!valid(config)) return VERICAN_ERR_RANGE;
  *tsyn = (verican_tsyn_t){0};
  result = verican_servo_init(&tsyn->servo, &config->servo);
  if (result != VERICAN_OK) return result; /* no device: nothing can be started */
  tsyn->config = *config;
  tsyn->dev = dev;
  return VERICAN_OK;
}

static verican_result_t start(verican_tsyn_t *tsyn, bool candidate) {
  if (tsyn == NULL) return VERICAN_ERR_NULL;
  uint64_t now = 0;
  const verican_result_t result = verican_clock_get(tsyn->dev, &now);
  if (result != VERICAN_OK) return result;
  verican_masters_start(&tsyn->masters, tsyn->config.servo.interval_us, now);
  tsyn->receiver = (verican_tsyn_receiver_t){0};
  tsyn->step = (uint8_t)TSYN_IDLE;
  tsyn->cut = false;
  tsyn->candidate = candidate;
  tsyn->sending = candidate && tsyn->config.master_count == 1u;
  tsyn->next = now;
  tsyn->latest = now;
  tsyn->started = true;
  return VERICAN_OK;
}

verican_result_t verican_tsyn_start_follower(verican_tsyn_t *tsyn) { return start(tsyn, false); }

verican_result_t verican_tsyn_start_master(verican_tsyn_t *tsyn) { return start(tsyn, true); }

static verican_result_t time_of(const verican_tsyn_t *tsyn, uint64_t *now) {
  const verican_result_t result = verican_tsyn_check(tsyn);
  return result == VERICAN_OK ? verican_clock_get(tsyn->dev, now) : result;
}

void verican_tsyn_look(verican_tsyn_t *tsyn, uint64_t now) {
  const int64_t passed = (int64_t)(now - tsyn->latest);
  if (passed >= -(int64_t)tsyn->masters.interval) return;
  verican_masters_shift(&tsyn->masters, passed);
  tsyn->servo.last = (int64_t)((uint64_t)tsyn->servo.last + (uint64_t)passed);
  tsyn->next += (uint64_t)passed;
  tsyn->latest = now;
}

verican_result_t verican_tsyn_poll(verican_tsyn_t *tsyn) {
  uint64_t now = 0;
  const verican_result_t result = time_of(tsyn, &now);
  if (result != VERICAN_OK) return result;
  verican_tsyn_look(tsyn, now);
  tsyn->latest = now;
  if (!tsyn->sending && verican_servo_poll(&tsyn->servo, now) && tsyn->config.on_event != NULL)
    tsyn->config.on_event(tsyn->config.user, tsyn, VERICAN_SERVO_STATE);
  if (tsyn->candidate) verican_tsyn_run_master(tsyn, now);
  return VERICAN_OK;
}

verican_result_t verican_tsyn_measure(verican_tsyn_t *tsyn, uint8_t exchanges) {
  const verican_result_t result = verican_tsyn_check(tsyn);
  if (result != VERICAN_OK) return result;
  if (tsyn->config.delay_request == tsyn->config.delay_response) return VERICAN_ERR_STATE;
  return verican_delay_start(&tsyn->delay, exchanges);
}

verican_result_t verican_tsyn_status(const verican_tsyn_t *tsyn, verican_tsyn_status_t *status) {
  uint64_t now = 0;
  const verican_result_t result = time_of(tsyn, &now);
  if (result != VERICAN_OK) return result;
  if (status == NULL) return VERICAN_ERR_NULL;
  status->state = (verican_sync_state_t)tsyn->servo.state;
  status->sending = tsyn->sending;
  status->sub_domain = tsyn->receiver.sub_domain;
  status->master = tsyn->masters.current;
  status->filter = tsyn->servo.filter;
  status->delay_ns = tsyn->servo.config.delay_ns;
  status->shift_ns = tsyn->shift;
  status->bound_ns = verican_servo_bound(&tsyn->servo, now);
  for (unsigned i = 0; i < (unsigned)VERICAN_TSYN_CAUSES; ++i)
    status->refused[i] = tsyn->receiver.refused[i];
  return VERICAN_OK;
}
