/* A machine that sells coffee, tea and milk for coins of 10, 20 and 50 cents. It gives change, and
   sells only what it has got and what is paid for. */
asm CoffeeMachine

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary

signature:
	enum domain Product = {COFFEE | TEA | MILK}
	enum domain Button = {PUSH_COFFEE | PUSH_TEA | PUSH_MILK | PUSH_RETURN | NO_BUTTON}
	domain Coin subsetof Integer

	static price: Product -> Integer
	static wanted: Button -> Product

	monitored inserted: Coin
	monitored pressed: Button

	controlled credit: Integer
	controlled cash: Integer
	controlled portions: Product -> Integer
	controlled sold: Integer
	out display: String
	out returned: Integer

	derived canSell: Product -> Boolean

definitions:
	domain Coin = {0, 10, 20, 50}

	function price($p in Product) =
		switch $p
			case COFFEE: 70
			case TEA: 60
			case MILK: 40
		endswitch

	function wanted($b in Button) =
		switch $b
			case PUSH_COFFEE: COFFEE
			case PUSH_TEA: TEA
			case PUSH_MILK: MILK
			otherwise undef
		endswitch

	function canSell($p in Product) =
		portions($p) > 0 and credit >= price($p)

	rule r_sell($p in Product) =
		par
			portions($p) := portions($p) - 1
			cash := cash + price($p)
			sold := sold + price($p)
			returned := credit - price($p)
			credit := 0
			display := concat("enjoy your ", toLower(toString($p)))
		endpar

	rule r_refuse($p in Product) =
		if portions($p) = 0 then
			display := "sold out"
		else
			display := concat("missing ", toString(price($p) - credit))
		endif

	rule r_press($b in Button) =
		if $b = PUSH_RETURN then
			par
				returned := credit
				credit := 0
				display := "cancelled"
			endpar
		else
			let ($p = wanted($b)) in
				if canSell($p) then r_sell[$p] else r_refuse[$p] endif
			endlet
		endif

	// A coin goes in before a button counts: one thing a step.
	rule r_insert =
		par
			credit := credit + inserted
			returned := 0
			display := concat("credit ", toString(credit + inserted))
		endpar

	// money is neither made nor lost
	invariant inv_cash over cash, sold: cash = 100 + sold
	invariant inv_credit over credit: credit >= 0 and credit mod 10 = 0
	invariant inv_portions over portions: (forall $p in Product with portions($p) >= 0)

	// the list of prices, and what each sale makes of money and stock
	invariant inv_prices over price: price(COFFEE) = 70 and price(TEA) = 60 and price(MILK) = 40
	invariant inv_stock over portions, sold:
		sold = 70 * (5 - portions(COFFEE)) + 60 * (5 - portions(TEA)) + 40 * (1 - portions(MILK))

	CTLSPEC ctlSpec_begins: credit = 0 and returned = 0 and display = "ready"
	// a coin is credit, whatever is pressed
	CTLSPEC ctlSpec_insert:
		(forall $c in {0, 10, 20, 30, 40, 50, 60}, $coin in {10, 20, 50} with
			ag(
				credit = $c and inserted = $coin
				implies ax(credit = $c + $coin and returned = 0 and display = concat("credit ", toString($c + $coin)))))
	// what is pressed is sold if it is there and paid for; the rest of the credit comes back
	CTLSPEC ctlSpec_coffee:
		(forall $c in {70, 80, 90, 100, 110} with
			ag(
				inserted = 0 and pressed = PUSH_COFFEE and credit = $c and portions(COFFEE) > 0
				implies ax(display = "enjoy your coffee" and credit = 0 and returned = $c - 70)))
	CTLSPEC ctlSpec_tea:
		(forall $c in {60, 70, 80, 90, 100, 110} with
			ag(
				inserted = 0 and pressed = PUSH_TEA and credit = $c and portions(TEA) > 0
				implies ax(display = "enjoy your tea" and credit = 0 and returned = $c - 60)))
	CTLSPEC ctlSpec_milk:
		(forall $c in {40, 50, 60, 70, 80, 90, 100, 110} with
			ag(
				inserted = 0 and pressed = PUSH_MILK and credit = $c and portions(MILK) > 0
				implies ax(display = "enjoy your milk" and credit = 0 and returned = $c - 40)))
	// nothing is sold without need, and it is said why
	CTLSPEC ctlSpec_soldOut:
		ag(
			inserted = 0
				and (
					pressed = PUSH_COFFEE and portions(COFFEE) = 0
					or pressed = PUSH_TEA and portions(TEA) = 0
					or pressed = PUSH_MILK and portions(MILK) = 0)
			implies ax(display = "sold out"))
	CTLSPEC ctlSpec_missing:
		(forall $c in {0, 10, 20, 30} with
			ag(
				inserted = 0 and pressed = PUSH_MILK and credit = $c and portions(MILK) > 0
				implies ax(display = concat("missing ", toString(40 - $c)) and credit = $c)))
	// the button for it gives all credit back; without a button nothing happens
	CTLSPEC ctlSpec_return:
		(forall $c in {0, 50, 110} with
			ag(
				inserted = 0 and pressed = PUSH_RETURN and credit = $c
				implies ax(display = "cancelled" and credit = 0 and returned = $c)))
	CTLSPEC ctlSpec_rests:
		(forall $c in {0, 50, 110} with
			ag(inserted = 0 and pressed = NO_BUTTON and credit = $c implies ax(credit = $c)))

	main rule r_Main =
		if inserted > 0 then
			r_insert[]
		else
			if pressed != NO_BUTTON then r_press[pressed] endif
		endif

default init s0:
	function credit = 0
	function cash = 100
	function sold = 0
	function portions($p in Product) = if $p = MILK then 1 else 5 endif
	function display = "ready"
	function returned = 0
