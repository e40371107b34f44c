// The instructions that expressions and module calls are compiled to.
#pragma once

#include <cstdint>

namespace language {

/// What an instruction does. It works on a stack of values: `pop` and `push` speak of its top.
/// Slots count from the base of the running code's frame; scopes are counted outwards from the
/// innermost heap scope, which is number 0.
enum class Op : uint8_t {
  // Values
  kConstant,  // push constants[b]
  kUndef,     // push undef
  kFalse,     // push false
  kPop,       // pop
  kSlide,     // drop the b values below the top
  kSwap,      // exchange the two topmost values
  kToBool,    // replace the top by its truth
  // Variables. A `try` pushes a variable that is set and then skips `flag` instructions.
  kLocal,            // push slot b
  kTryLocal,         // the same, if it is set
  kScoped,           // push variable b of scope a
  kTryScoped,        // the same, if it is set
  kDynamic,          // push the `$` variable b, or warn
  kDynamicSilently,  // push the `$` variable b, or undef
  kUnknownVariable,  // warn of the name b, push undef
  kStoreLocal,       // pop into slot b
  kStoreScoped,      // pop into variable b of scope a
  kBindDynamic,      // pop, and bind the `$` variable b to it until the trail is undone
  kMarkTrail,        // push the length of the trail
  kUndoTrail,        // undo the trail back to the length in slot b
  kEndDynamic,       // pop a value, undo the trail to the mark that is popped next, push the value
  kPushScope,        // open a heap scope of b variables, all unset
  kPopScope,         // close it
  kRenewScope,       // go on with a copy of it, if something else refers to it
  // Operators
  kNegate,
  kNot,
  kComplement,
  kPower,
  kMultiply,
  kDivide,
  kModulo,
  kAdd,
  kSubtract,
  kShiftLeft,
  kShiftRight,
  kBitAnd,
  kBitOr,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kIndex,
  kIndexLocal,    // replace the top, an index, by the element of slot a
  kMember,        // replace the top by its member named b; flag: a MemberPosition
  kMemberLocal,   // push that of slot a
  kRange,         // pop begin, end and perhaps step, as RangeFlag says; push a range
  kUnlessNumber,  // go to b unless the top is a number
  kVector,        // pop b values into a vector
  kFunction,      // push a function value of functions[b]
  kIsUndef,
  // Control
  kJump,          // go to b
  kJumpIfFalse,   // pop; go to b if it is not true
  kAssert,        // b: asserts[b]; pops the message if flag, then the condition
  kEcho,          // b: echoes[b]; pops its values
  kDuplicateLet,  // pop a value and warn that the name b has one already
  kUnnamedLet,    // pop a value and warn that it has no name
  // Comprehensions and loops
  kBeginVector,      // push an empty vector
  kAppend,           // pop, and append to the vector in slot b
  kAppendEach,       // the same with each element of the value
  kAppendEachOfAll,  // pop a vector, and do so with each of its elements
  kBeginLoop,        // replace the top by what it iterates over, push how many rounds are done (0)
                     // and how many there are
  kReserve,          // make room in the vector in slot b for as many elements as the top says
  kNextRound,        // push the next element, or go to b; the loop's three values begin in slot a
  kCountRound,       // slot b counts the rounds of a C-style for
  // Calls
  kEnterUnit,    // make the top level of unit b ready for a call
  kBeginCall,    // push the declared parameters of calls[b], with their defaults
  kCall,         // call the function of calls[b], whose parameters are on top; flag: in place of
                 // the running function
  kCallBuiltin,  // call builtin function b with the a values on top; a flag gives up slot
                 // flag - 1, which is read no more, before that
  kNextLazy,     // go to the argument that lazy_calls[b] evaluates next, or call it
  kKeepLazy,     // pop a value and add it to the arguments of lazy_calls[b]
  kWarnCount,    // say that builtin function b got a, a wrong number of arguments; push
                 // undef
  kUnknownFunction,   // warn of the name b; push undef
  kArgumentWarnings,  // say the warnings of plans[b]; once if flag
  kIfFunction,        // go to b if the top is a function value
  kPrepareCall,       // begin dynamic_calls[b], whose callee is on top
  kNextArgument,      // go to the next argument of dynamic_calls[b]
  kCallDynamic,       // call it
  kUnlessCalledAs,    // go to b unless the running function value was called by the name a
  kCachedDefault,     // push caches[a] and go to b if it is set
  kStoreCache,        // store the top in caches[a]
  kTailJump,          // drop all above the first a values of the frame, start anew at b
  kReturn,            // return the top from a function
  kReturnDefaults,    // the parameters have their defaults
  // Modules
  kUnknownModule,   // warn of the name b
  kBeginNode,       // begin a node: node_sites[b]
  kEndNode,         // end it; flag: leave it out if it has no children
  kSuccessor,       // say that a builtin module is deprecated: node_sites[b]
  kRefuseChildren,  // say that a builtin module takes no children: node_sites[b]
  kWantsFirst,      // go to b unless the module of node_sites[a] wants its first argument again
  kMakeNode,        // pop the parameters, make a builtin module's node, go to b if it is no parent
  kSaveBlock,       // remember the scope of the block of calls[b]
  kNameModule,      // the user module of calls[b] counts among those that run from here on
  kCountModules,    // bind $parent_modules to the user modules that run
  kCallModule,      // call the user module of calls[b], whose parameters are on top
  kChildCount,      // push $children
  kParameterLiteral,  // if the value on top is set, say that the name b, a parameter, is
                      // overwritten
                      // with a literal; pop
  kReturnModule,
  kUnlessInModule,   // go to b if the code is not within a user module
  kAllChildren,      // begin a group, run all children in it
  kDeprecatedChild,  // say that child() is deprecated
  kSelectChildren,   // check the selection of children on top; push how many are done, 0, and
                     // whether they go into a group, which is begun; flag: of child(). Goes to b,
                     // and drops the selection, if there is nothing to run
  kRunChildren,   // pop which children are meant; begin the group node_sites[a] and run them in it,
                  // or go to b if there is nothing to run; flag: of child()
  kNextChild,     // run the next child of the selection in slot a; go to b after the last
  kEndSelection,  // end the group, if there is one; drop what kSelectChildren pushed
  kEndChild,      // a statement of a block has ended
  kEndUnit,       // the assignments of a top level have been evaluated
};

/// Flags of kMember and kMemberLocal: the element of a vector that the name means, if there is one.
enum MemberPosition : uint16_t { kX, kY, kZ, kNoPosition };
/// Flags of kBeginLoop: which limit of rounds holds.
enum LoopKind : uint16_t { kElementLoop, kStatementLoop };
/// Flags of kRange.
enum RangeFlag : uint16_t { kHasStep = 1, kChecksDirection = 2 };

struct Instruction {
  Op op;
  uint16_t flag = 0;
  uint32_t a = 0;
  uint32_t b = 0;
};

}  // namespace language
