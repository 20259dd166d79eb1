# Formal proofs

What is proven of the RTL for every input and every state, not for the inputs of a test; and how each proof
is itself shown able to fail. Properties: [`tb/formal`](../tb/formal).

```sh
tb/formal/run.py                      # prove everything
tb/formal/run.py --mutants            # and demand that every mutant is caught
tb/formal/run.py --only engine.crc15  # one proof (or a part: engine, host)
tb/formal/run.py --list               # properties, rules and assumptions
```

## Adding a proof

A proof is an entry of `tb/formal/<part>/proofs.yaml`:

| key | meaning |
|---|---|
| `name`, `title` | the proof is called `<part>.<name>` |
| `top`, `rtl`, `params` | top module, RTL files relative to `rtl/` (`can_pkg.sv` is added), parameters |
| `splice` | module: file or list of files of `tb/formal/<part>/`, spliced into a copy of the module before its `endmodule` |
| `files` | more SystemVerilog files, such as a wrapper |
| `method` | `pdr` (abc, unbounded), `induction` (k-induction), `bounded`, `cover` |
| `depth` | clocks of `induction`, `bounded`, `cover` |
| `solver` | `z3` or `boolector`, of all but `pdr`; `abc`: bmc3, for `bounded` alone |
| `memories` | true: memories stay memories (not for `pdr`) |
| `search` | how mutants are hunted: `pdr`, `bmc` (abc bmc3), `smt` (yosys-smtbmc); default by method |
| `quick` | true: also in `make test` |
| `mutants` | each `name`, `file`, `old` text (must stand once), `new` text, `breaks` (labels), `depth` |

Statements are immediate (`assert`, `assume`, `cover`) and labelled in lower case: `p_` property, `l_` lemma
that only helps a proof, `m_` assumption about inputs, `c_` cover. The comment above a property starts with
its rule ids. Every `p_` needs a mutant that breaks it: with the mutant in the RTL the solver has to find a
counterexample to that very property.

## The engine

Every flip-flop of the engine has a reset, so a reset in the middle of a run begins the same run anew; the
proofs have one reset, in their first clock, and none later.

| proof | what is proven | how far |
|---|---|---|
| `engine.crc15` | each bit divides once by the generator, stuff bits do not, the register starts from 0, all 15 bits are compared | every state |
| `engine.bsp_always` | what must hold in every bit (TH-06): never six equal bits, dominant only where the node may be, nothing while off the bus, edges at bit boundaries, at most one counter step a sample, each in its role, delivery at EOF6, success at EOF7, each attempt ends once and is told, CRC register 0 at each start | every bus, every request, every length of the bit |
| `engine.fault_steps` | each step of TEC and REC, with its cause, against the rules written down anew in the property file; no step at any other moment; bus-off above 255; passive limits; REC does not wrap | the same |
| `engine.recovery` | from *any* value of *all* flip-flops of the bit stream processor, without reset: illegal codes are left within two bits, and a rank of the state falls within every two bits until the node is idle | quiet bus, automatic recovery |
| `engine.liveness` | a pending frame starts within 26 bits, 12 when integrating (TH-07) | from every state between frames, in a flag or delimiter that `bsp_always.p_places` and `p_level` allow; quiet bus; 80 clocks cover the 26 bits |
| `engine.timing` | which edges synchronise, one a bit; the quantum in which the bit ends; the majority of three samples | every configuration with SJW at most PHASE_SEG1 and PHASE_SEG2 |
| `engine.mode_waits` | the modes let the engine run again only after it has stopped | every request |
| `engine.timing_sample` | the quantum of the next sample point after any edge, early, late or hard; the length of the bit within SJW | bits of 8 quanta, SJW 1 to 3 |

`bsp_always` and `fault_steps` look at the whole bit stream processor with a free bus: any level at any sample,
requests and stops at any clock, counters written to any value while stopped. So they need no list of
situations. The way back in `recovery` is a bounded search of four bits, yet holds for ever: its first state is
arbitrary, so each later state is the first state of the same search again.

A defect was found so: bus-off recovery (`FldBusOff`) without bus-off counted its sequences in REC and never
ended. It took one flipped flip-flop to get there. `can_field` now integrates
(`CanField.RecoveryWithoutBusOffLeadsToIntegration`).

## Message buffers and AHB slave

## Assumptions and where they are discharged

| assumption | made in | where it comes from |
|---|---|---|
| one sample a bit, not in its first clock; the bit ends after its sample | `bsp_inputs.sv` | `timing.p_one_sample`, `p_one_boundary`, `p_not_first` |
| `judge_i` follows `boundary_i` | `bsp_inputs.sv` | `first_q` of `can_core` |
| a stop waits for a recessive level | `bsp_inputs.sv` (`m_run`) | `active_q` of `can_core`, copied into the assumption |
| who asked for a stop waits until the node has stopped (`m_stay`) | `bsp_inputs.sv` | `mode_waits.p_run_waits`; without it a proof shows a dominant bit outside a frame |
| modes and bit timing constant while running | `bsp_inputs.sv`, `timing_rules.sv` | registers, writable in freeze mode alone |
| the level sent changes at boundaries alone | `timing_rules.sv` | `bsp_always.p_edges` |

## What is not proven

- `liveness` is about a node that is not in a frame, and not in bus-off.
- Stuffing and destuffing as inverses of each other for symbolic streams. Proven is that the output never has
  six equal bits; that what is received is what was sent is checked in simulation.
- The sample point of bits of other lengths than 8 quanta: `s14_sync_sweep_test` and the tq sweep. The solvers
  did not decide it with all lengths symbolic.
- The engine as one model from pin to pin: the bit stream processor and the bit timing are proven apart.
- `bsp_always` and `fault_steps` take causes (error, lost arbitration) from `can_error`; whether each error is
  seen at its bit is the matter of the error injection matrix and of lockstep.
- Metastability, clock domains, timing of gates: not in the model.
