//! Loads that nothing uses, which Cranelift leaves where they are.
//!
//! In: a function as the translator has built it, which marks places that only some code gives back to. Out: the same function
//! without the loads of which no result is used.

use cranelift_codegen::entity::EntitySet;
use cranelift_codegen::ir::{Function, Inst, Value};

/// See the module.
pub(super) fn drop_unused_loads(function: &mut Function) {
    let mut used: EntitySet<Value> = EntitySet::new();
    let mut loads: Vec<Inst> = Vec::new();
    for block in function.layout.blocks() {
        for inst in function.layout.block_insts(block) {
            for value in function.dfg.inst_values(inst) {
                used.insert(function.dfg.resolve_aliases(value));
            }
            if function.dfg.insts[inst].opcode().can_load() && !function.dfg.insts[inst].opcode().is_call() {
                loads.push(inst);
            }
        }
    }
    for inst in loads {
        let trusted = function.dfg.insts[inst].memflags().is_some_and(|flags| flags.trap_code().is_none());
        if trusted && function.dfg.inst_results(inst).iter().all(|result| !used.contains(*result)) {
            function.layout.remove_inst(inst);
        }
    }
}
